// Joint commands that bring the real arm's tool to wanted poses.
#ifndef DHCAL_TOOLS_COMPENSATE_COMPENSATE_H_
#define DHCAL_TOOLS_COMPENSATE_COMPENSATE_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/compensate/real_arm.h"

namespace dhcal {

/// A row's command, and what the arm's model leaves there.
struct Command {
  Eigen::VectorXd q;          // as the controller counts [rad or m]; where refused the seed
  double position_error = 0;  // [m]
  double rotation_error = 0;  // [rad]
  std::string refusal;        // why there is none, or ""
};

/// What the arm's model may leave: a nanometre and a nanoradian.
constexpr double kSettledPosition = 1e-9;  // [m]
constexpr double kSettledRotation = 1e-9;  // [rad]

/// Where the search for commands starts, and so on which branch the arm is.
struct Seeds {
  Eigen::MatrixXd q;        // rows x joints
  bool first_only = false;  // rows after the first start from the command before them
};

/// One command per row of `X_WQ`. Effects depend on the command and the command on them: both are
/// iterated until they agree.
std::vector<Command> Compensate(const RealArm& arm,
                                const std::vector<Eigen::Isometry3d>& X_WQ,
                                const Seeds& seeds);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPENSATE_COMPENSATE_H_
