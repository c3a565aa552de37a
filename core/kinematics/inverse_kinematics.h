// Joint coordinates at which a chain holds its tool at a pose: damped Newton steps with the
// analytic derivative, from a seed whose branch (elbow, wrist) they keep.
//
//   e(q) = [p_WQ* - p_WQ(q);  Log(R_WQ* R_WQ(q)')]              6 rows, lengths over the reach
//   dq   = J'(J J' + lambda^2 I)^-1 e                           Nakamura, Hanafusa (1986)
//
// Chains of more than six joints move as little as they can from the seed. Chains of fewer bring
// the point to its place exactly, and the orientation as near as the joints then can (task
// priority: Nakamura, Hanafusa, Yoshikawa 1987).
#ifndef DHCAL_CORE_KINEMATICS_INVERSE_KINEMATICS_H_
#define DHCAL_CORE_KINEMATICS_INVERSE_KINEMATICS_H_

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/kinematics/dh_chain.h"
#include "core/model/robot.h"

namespace dhcal {

/// Where the chain stands beside its joint coordinates.
struct ChainState {
  Eigen::VectorXd delta;  // per slot
  EndFrames ends;
};

struct InverseOptions {
  double position_tolerance = 1e-10;  // [m]
  double rotation_tolerance = 1e-10;  // [rad]
  int max_iterations = 200;
};

struct InverseSolution {
  bool found = false;
  Eigen::VectorXd q;          // as the controller counts; the best there is where not found
  double position_error = 0;  // [m] that is left
  double rotation_error = 0;  // [rad]
  std::string reason;         // why not, as a sentence without its end
};

/// Immutable; keeps a copy of the robot.
class InverseKinematics {
 public:
  /// Joint limits are those of the robot's rows.
  explicit InverseKinematics(const RobotModel& robot);

  const DhChain& chain() const { return chain_; }

  /// Refuses with a reason: targets out of reach, joints beyond their limits (whole turns are
  /// tried), and poses at which the joints cannot move the tool in all directions that they are
  /// there for, since a command near them says nothing of where the arm goes.
  InverseSolution Solve(const Eigen::Isometry3d& X_WQ,
                        const ChainState& state,
                        const Eigen::VectorXd& seed,
                        const InverseOptions& options = {}) const;

 private:
  struct Errors;

  Errors ErrorsAt(const Eigen::Isometry3d& X_WQ,
                  const ChainState& state,
                  const Eigen::VectorXd& q) const;
  Eigen::VectorXd Step(const Errors& errors, double damping) const;
  /// Newton steps; `limited`: joints stop at their limits.
  InverseSolution Descend(const Eigen::Isometry3d& X_WQ,
                          const ChainState& state,
                          const Eigen::VectorXd& seed,
                          const InverseOptions& options,
                          bool limited) const;
  /// Whole turns that bring joints within their limits; the first joint that stays beyond, or -1.
  int TurnIntoLimits(Eigen::VectorXd* q) const;
  bool IsSettled(const Errors& errors,
                 const Eigen::VectorXd& step,
                 const InverseOptions& options) const;
  std::string BeyondLimit(int joint, double q) const;

  RobotModel robot_;
  DhChain chain_;
  double reach_;  // [m] weighs lengths against angles
};

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_INVERSE_KINEMATICS_H_
