// Gauss-Newton with step halving on geometry, effects and masses together, and what the solution
// says of each member.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_FIT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_FIT_H_

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "problems/diagnosis/refit/joint_model.h"

namespace dhcal {

/// Steps of a fit that may start far from its end: with a large misfit priors hold back at first.
/// It ends when it settles.
constexpr int kFarSteps = 12;

/// Squares that a fit minimises: of the rows and, times `phi`, of the priors.
double SquaresLeft(const JointModel& model, const JointRows& joint, double phi);

/// Fits from `start`; the result is the best state seen, linearised.
JointRows FitJointly(const JointModel& model,
                     const JointState& start,
                     const RowChoice& choice,
                     const std::vector<int>& free,
                     int iterations);

/// N without what the elastic members' own columns can do beside geometry A (both under the
/// priors): else the freedom of the masses contains the effect itself.
Eigen::MatrixXd TiedMasses(const JointModel& model, const JointRows& joint);

/// Values of the members' parameters as they are with the masses that were stated: what the masses'
/// errors do in the direction of the elastic members counts as theirs.
Eigen::VectorXd TiedValues(const JointModel& model, const JointRows& joint);

/// [A N X] over the priors' rows, and the same of y; columns as they come, SI and priors.
struct Augmented {
  Eigen::MatrixXd B;
  Eigen::VectorXd y;
  int num_free = 0, num_members = 0, num_masses = 0;  // order of the columns: A, X, N
};
Augmented AugmentedRows(const JointModel& model, const JointRows& joint, const Eigen::MatrixXd& N);

/// Cholesky factor of B'B with the columns scaled to unit length. Priors' rows make it regular.
class NormalFactor {
 public:
  explicit NormalFactor(const Eigen::MatrixXd& B);
  /// (B'B)^-1 b.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd Inverse() const;
  /// Rows whose squared lengths are the leverages of `rows` in the fit.
  Eigen::MatrixXd Whiten(const Eigen::MatrixXd& rows) const;

 private:
  Eigen::VectorXd scale_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// Covariance of free geometry and members at a fit, for rows of unit variance; masses tied.
Eigen::MatrixXd JointCovariance(const JointModel& model, const JointRows& joint);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_FIT_H_
