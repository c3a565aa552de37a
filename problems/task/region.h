// Poses of a robot that stand for a region of its space.
#ifndef DHCAL_PROBLEMS_TASK_REGION_H_
#define DHCAL_PROBLEMS_TASK_REGION_H_

#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "core/model/robot.h"
#include "core/model/task.h"

namespace dhcal {

/// How far each joint goes: its limits; +-180 deg where a turning joint has none.
struct JointRange {
  Eigen::VectorXd low, high;  // [rad or m] as the controller counts

  explicit JointRange(const RobotModel& robot);
  Eigen::VectorXd Draw(Rng* rng) const;
};

/// Seeded random poses of the nominal robot with its point in the box, uniform in the joints'
/// range where enough of that reaches the box, else also by inverse kinematics from there to
/// uniform points of the box. Fewer than `count`, or none, where those are out of reach.
Eigen::MatrixXd DrawInBox(const RobotModel& robot,
                          const TaskBox& box,
                          int count,
                          std::uint64_t seed);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_TASK_REGION_H_
