// Every form of every item as whitened columns at one state of the model, with geometry and masses
// taken out, and the few of them that a search should look at.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_BANK_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_BANK_H_

#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/hypotheses/item.h"
#include "problems/diagnosis/refit/joint_model.h"
#include "problems/diagnosis/search/gram.h"

namespace dhcal {

class Bank {
 public:
  /// `joint`: the state; its own members join the items where they are none yet, and their part of
  /// the rows is given back, so that everything competes from nothing. `geometry`: unknowns that
  /// are taken out; what the state has of the others is given back, too.
  Bank(const JointModel& model,
       const JointRows& joint,
       std::vector<Item> items,
       const std::vector<int>& geometry);

  const std::vector<Item>& items() const { return items_; }
  /// Positions of the model's members among the items.
  const std::vector<int>& members() const { return members_; }
  double rss() const { return rss_; }

  /// Squares that each item would remove beside some (`active`, positions).
  Eigen::VectorXd Gains(const std::vector<int>& active) const;
  /// What is left of the rows beside some items, and an orthonormal basis of all that was taken
  /// out.
  struct Rest {
    Eigen::MatrixXd basis;
    Eigen::VectorXd y;
  };
  Rest RestBeside(const std::vector<int>& active) const;
  /// Squares that an item, which need not be one of the bank's, would remove of a rest.
  double GainBeside(const Rest& rest, const Item& item) const;
  /// Adds an item after all (a line or a time constant that a scan found); its columns are in the
  /// state's context.
  void Add(Item item);

  Gram GramOf(const std::vector<int>& chosen) const;

 private:
  void TakeOut(const JointModel& model, const std::vector<int>& geometry);
  Eigen::MatrixXd Columns(const Item& item) const;
  void Append(int item, const Eigen::MatrixXd& columns);
  /// Rows of the Gram matrix that belong to some items, beside what is taken out; all columns.
  Eigen::MatrixXd GramRows(const std::vector<int>& chosen) const;
  std::vector<int> ColumnsOfItems(const std::vector<int>& chosen) const;

  const JointRows& joint_;
  std::vector<Item> items_;
  std::vector<int> first_;  // column of each item
  std::vector<int> members_;
  Eigen::MatrixXd Q_;   // of the rows: what is taken out (with its priors' rows it is orthonormal)
  Eigen::VectorXd qy_;  // Q'y, priors' rows included
  Eigen::VectorXd y_;   // rows, members given back
  double rss_ = 0;
  int num_columns_ = 0;
  Eigen::MatrixXd C_, T_;  // rows x columns, Q'C
  Eigen::VectorXd b_, norm2_;
  Eigen::VectorXd prior_;                // squares that the items' priors add to the diagonal
  std::vector<Eigen::MatrixXd> blocks_;  // own Gram matrix of each item
  mutable Eigen::MatrixXd member_rows_;  // GramRows of the members; made when asked for
};

/// The items worth searching: the best form of each name and place, and of the cells, beside the
/// members, beside all but one of them, and beside nothing.
std::vector<int> Shortlist(const Bank& bank, const EvidenceRule& rule);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_BANK_H_
