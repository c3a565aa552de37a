// Prediction of rows that were not fitted: the test rows where there are any, else rows left out in
// three ways. What is true is seen by at least one of the ways: a step cannot be known from the
// rows before it, nor a curve where its joint has not been.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_UNSEEN_ROWS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_UNSEEN_ROWS_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/refit/joint_model.h"

namespace dhcal {

class UnseenRows {
 public:
  /// By the linear model at `joint`; `test` (may be empty): readings that were not fitted.
  UnseenRows(const JointModel& model,
             const JointRows& joint,
             const RowChoice& choice,
             const std::vector<Reading>& test);

  /// "set column", or how rows were left out.
  const std::string& method() const { return ways_[announced_].method; }
  /// Figures by the same way as those of another model of the same rows.
  void AnnounceAs(const UnseenRows& other) { announced_ = other.announced_; }
  int num_ways() const { return static_cast<int>(ways_.size()); }

  /// RMS of a coordinate [m], raw: of the fitted rows, and of rows not fitted, by the first
  /// way that does not ask for what its rows cannot know (the instant of a step, say).
  /// `dropped`: members (positions) that the model may not use.
  double FittedRms(const std::vector<int>& dropped) const;
  /// Of the fitted rows, with the masses as they are stated.
  double RmsOfStatedMasses(const std::vector<int>& dropped) const;
  double UnseenRms(const std::vector<int>& dropped) const;

  /// What the members of a group gain on unseen rows: half the sum over readings of the bounded
  /// squares without them less those with them, and its standard error.
  struct Gain {
    double sum = 0, error = 0;
  };
  Gain GainOf(const std::vector<int>& group, int way) const;
  /// True if every way speaks against the group; for a line that a scan found, if none speaks for
  /// it: a tooth that is there is there for all rows alike, and a scan finds what a few rows make.
  bool SpeakAgainst(const std::vector<int>& group) const;

 private:
  struct Rows {
    Eigen::MatrixXd A;  // unknowns as in the fit
    Eigen::VectorXd y;  // members given back
  };
  struct Part {
    Eigen::MatrixXd H;  // of the rows that are fitted in it, priors included
    Eigen::VectorXd b;
    std::vector<int> predicted;  // rows of `white` and `raw` of its way
  };
  struct Way {
    std::vector<Part> parts;
    std::string method;
    bool test = false;
  };
  Rows RowsOf(const JointRows& joint) const;
  void AddWay(const std::string& method, const std::vector<int>& fold_of_row, int folds);
  void ChooseAnnounced();
  double RmsOfWay(const Way& way, const std::vector<int>& dropped) const;
  std::vector<int> Kept(const std::vector<int>& dropped) const;
  Eigen::VectorXd Solve(const Part& part, const std::vector<int>& kept) const;
  /// Residuals of the rows that a way predicts.
  Eigen::VectorXd Residuals(const Way& way, const std::vector<int>& dropped, bool raw) const;

  int coordinates_;
  int num_free_ = 0;
  std::vector<int> first_;  // column of each member
  std::vector<int> size_;
  std::vector<bool> elastic_;
  std::vector<bool> scanned_;
  std::vector<int> mass_idx_;
  Eigen::VectorXd mass_value_;  // at the fit, in units of the masses' priors
  std::vector<int> row_of_;     // recording row of each fitted row
  Rows white_, raw_, test_white_, test_raw_;
  Part all_;
  std::vector<Way> ways_;
  std::size_t announced_ = 0;  // way
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_UNSEEN_ROWS_H_
