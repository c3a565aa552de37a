// Noise that enters by the joints: an arm that does not stand where its encoders say scatters more
// where its lever is longer, and across the lever only.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_JOINT_NOISE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_JOINT_NOISE_H_

#include <Eigen/Core>

namespace dhcal {

struct LikeliestJointNoise {
  double sigma = 0;     // [rad] of every turning joint's angle, each reading its own
  double rest = 1;      // phi below: variance of what does not enter by the joints
  double evidence = 0;  // twice the logarithm of how much likelier it is than none
};

/// Of residuals `y` with covariance phi I + sigma^2 J J' per reading, phi and sigma unknown. `J`:
/// rows x turning joints, d y / d angle; both come `coordinates` rows to a reading, white but for
/// what is sought.
LikeliestJointNoise FindJointNoise(const Eigen::VectorXd& y,
                                   const Eigen::MatrixXd& J,
                                   int coordinates);

/// Twice the logarithm of how much likelier residuals `y` are with covariance phi I + J J' per
/// reading than with phi I, phi unknown in both: below 0 where they are less than J J' makes them.
double EvidenceOfCovariance(const Eigen::VectorXd& y, const Eigen::MatrixXd& J, int coordinates);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_JOINT_NOISE_H_
