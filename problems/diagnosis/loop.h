// The decision: rows, a robust first model, then rounds of search, joint fit and outliers, then
// elimination; for files that do not free everything once more with the completions of the geometry
// as hypotheses. Nothing is decided for good before the end.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_LOOP_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_LOOP_H_

#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/hypotheses/bank.h"
#include "problems/diagnosis/hypotheses/library.h"
#include "problems/diagnosis/refit/joint_fit.h"
#include "problems/diagnosis/refit/joint_model.h"
#include "problems/diagnosis/rows/joint_noise.h"
#include "problems/diagnosis/search/beam.h"
#include "problems/progress.h"

namespace dhcal {

struct LoopInputs {
  const JointModel* model = nullptr;
  std::vector<std::string> names;  // that may be given; empty = all
  std::vector<int> file_unknowns;  // that the problem file frees
  std::vector<Item> completions;   // what it leaves out, of the geometry
  double false_alarm = 0.01;
  bool sigma_known = false;      // stated, and the rows are single draws
  double readings_per_pose = 1;  // rows that are one draw together
  ReadOut read_out;              // of the joints
  Noise noise;                   // stated, or a first guess
  Progress progress;
};

struct LoopOutcome {
  JointRows fit;                  // members found, all good rows
  std::vector<Item> completions;  // found
  std::vector<int> geometry;      // unknowns of the fit but for the completions found
  std::vector<int> free;          // unknowns of the fit
  Noise noise;
  bool overstated = false;   // the stated noise was, and is not relied on
  SlowNoise slow;            // of the rows' errors, taken out
  double joint_noise = 0;    // [rad] of the turning joints' angles
  std::set<int> off;         // recording rows set aside, test rows too
  std::map<int, int> moved;  // of those, which a joint (from 0) moved where it stood
  EvidenceRule rule;
  std::vector<std::vector<Item>> listed;  // sets that are not told apart, the found one first
};

/// One diagnosis' loop over its rows.
class Loop {
 public:
  explicit Loop(const LoopInputs& inputs);

  LoopOutcome Run();

  /// Good rows; of a long recording those that are searched, evenly over it, or `all`.
  RowChoice Choice(bool all = false) const;
  /// Readings of the fit, or the test rows, without those that are off.
  std::vector<Reading> GoodReadings(bool test) const;
  double NumPoses() const;
  EvidenceRule RuleAt(const JointRows& joint, std::size_t geometry, int names) const;
  std::vector<Item> Items(const JointRows& joint, bool coarse) const;
  /// A fit of the rows chosen, of `geometry` and completions, without the members and completions
  /// that do not stand in it, the weakest first.
  JointRows Eliminate(JointState start,
                      const std::vector<int>& geometry,
                      const RowChoice& choice,
                      int iterations,
                      std::vector<Item>* completions) const;

 private:
  void RobustStart();
  /// Which rows are good, and what noise they have, by what a fit of the whole model leaves. True
  /// if anything changed; the fit is made anew where its rows have other weights at once.
  bool UpdateRows(JointRows* joint);
  /// Of each reading by itself: without robust weights, and nothing that wanders taken out.
  RowWeights WeightsOfNoise() const;
  void UpdateOutliers(const JointRows& joint, bool with_leverage);
  void UpdateNoise(const JointRows& joint);
  /// Takes joint columns for commanded angles, exact however few decimals they have, where their
  /// rounding would make the rows scatter more than they do. True if it changed.
  bool DoubtRounding(const JointRows& joint);
  /// Relies no more on a stated noise that is much larger than what is left.
  void DoubtNoise(const JointRows& joint);
  /// Takes slow noise out from here on, where what the whole model leaves has any: estimated any
  /// earlier it would eat physics wherever neighbouring rows are neighbouring poses. Members that
  /// go by the clock have to explain the rows better than it does. True if it changed.
  bool UpdateSlowNoise(const JointRows& joint);
  /// Takes noise that enters by the joints for such from here on, where it is likelier than all
  /// that was found: beside a real error of the joints it would take what others leave, and the
  /// evidence for them. True if it changed.
  bool UpdateJointNoise(const JointRows& joint);
  LikeliestJointNoise JointNoiseInsteadOfMembers(const JointRows& joint) const;
  /// Moves the instants of steps over all fitted rows, those set aside included: a step that came a
  /// few rows too early makes good rows lie off, and without them it would stay there.
  JointRows WithInstantsMoved(JointRows joint) const;
  /// For developers: GLOG_v=1 logs what each step holds.
  void Trace(const std::string& step, const JointRows& joint) const;
  /// Unknowns of the slots that members move from a zero that nobody knows.
  std::vector<int> UnknownZeros(const JointRows& joint) const;
  /// `with_rivals`: for a list of what is not told apart.
  void AddLines(const JointRows& joint,
                const EvidenceRule& rule,
                bool with_rivals,
                Bank* bank) const;

  /// A search at a fit; items and values of the best set.
  struct Found {
    std::vector<Item> items;
    std::vector<Eigen::VectorXd> values;
    std::vector<std::vector<Item>> listed;
    int names = 1;
  };
  Found SearchAt(const JointRows& joint,
                 const std::vector<int>& geometry,
                 const std::vector<Item>& completions,
                 bool list) const;
  LoopInputs in_;
  const JointModel& model_;
  std::vector<int> poses_;
  Noise noise_;
  std::set<int> off_;
  std::map<int, int> moved_;
  Eigen::VectorXd weight_;
  SlowNoise slow_;
  double joint_noise_ = 0;
  bool overstated_ = false;
  int names_ = 1;
};

/// Unknowns of some completions added to others.
std::vector<int> WithUnknowns(std::vector<int> geometry, const std::vector<Item>& completions);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_LOOP_H_
