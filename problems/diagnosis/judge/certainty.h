// How sure the members of a joint fit are.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CERTAINTY_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CERTAINTY_H_

#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/refit/joint_model.h"
#include "problems/diagnosis/search/gram.h"

namespace dhcal {

/// Log of the probability that noise lets `columns` remove `gain` of the squares `rss`: chi-square
/// where sigma is known (and enlarged where the rest exceeds it), else F.
double LogChanceOfGain(double gain, int columns, double rss, const EvidenceRule& rule);

/// Variance of the rows at a fit in units of what whitened them: at least 1 with a known sigma.
double RowVariance(const JointRows& joint, const EvidenceRule& rule);

struct Certainty {
  double log_p = 0;  // alone, without the choice among names
  Eigen::VectorXd value, sigma;
  /// To be shown: the same, or, where no single value is certain although all together are, their
  /// part along the directions that the readings hold best.
  Eigen::VectorXd shown_value, shown_sigma;
};

/// Fills what is shown of a value and its sigma, C their covariance: directions are left out, the
/// least certain first, until one value is certain or none is left.
void ShowWhatIsHeld(const Eigen::MatrixXd& C, Certainty* certainty);

/// Of a joint fit: members by Wald's test, completions by a refit without each.
struct Certainties {
  std::vector<Certainty> members, completions;
  Eigen::MatrixXd covariance;  // of free geometry and members, for rows of unit variance
};

/// `rule`.dof is the rows' freedom.
Certainties CertaintiesOf(const JointModel& model,
                          const JointRows& joint,
                          const std::vector<Item>& completions,
                          const EvidenceRule& rule);

/// The least sure member or completion that does not stand: its probability corrected for the
/// choice exceeds `false_alarm`, its sign is impossible, or its size is. Both -1 where all stand.
struct Weakest {
  int member = -1;
  bool by_size = false;  // the member is sure, but beyond all usual sizes
  int completion = -1;
};
Weakest WeakestOf(const JointModel& model,
                  const JointRows& joint,
                  const std::vector<Item>& completions,
                  const EvidenceRule& rule,
                  double false_alarm);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CERTAINTY_H_
