// Poses that a robot could be measured at, in groups that are measured together.
#ifndef DHCAL_PROBLEMS_PLAN_CANDIDATES_H_
#define DHCAL_PROBLEMS_PLAN_CANDIDATES_H_

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "core/model/task.h"

namespace dhcal {

/// How a straight edge is put down and gone along.
struct EdgePlan {
  double length = 0.5;          // [m] of the way along it
  double stand_off = 0.06;      // [m] of the tool point from its face
  double tilt = 25 * kDegree;   // [rad] the tool's rotation vector's components in +- tilt
  double slope = 20 * kDegree;  // [rad] roll and pitch of the face in +- slope
  int poses = 20;               // along it
};

struct Candidates {
  Recording rows;  // joint coordinates and labels; without readings
  std::vector<int> group_of_row;
  int count = 0;            // of groups
  std::vector<Edge> edges;  // one per group, where edges are read; X_WE
  int tried = 0;            // draws that it took
};

/// Seeded random poses within the joints' limits, with the point in `volume` (axes of the base)
/// where there is one. Fewer than `count` where the robot cannot get there.
Candidates DrawPoses(const RobotModel& robot,
                     const std::optional<TaskBox>& volume,
                     int count,
                     Rng* rng);

/// Placements of a straight edge with a straight line of poses over each.
Candidates DrawEdges(const RobotModel& robot,
                     const std::optional<TaskBox>& volume,
                     const EdgePlan& plan,
                     int count,
                     Rng* rng);

/// The rows of some groups, in their order.
Recording RowsOfGroups(const Candidates& candidates, const std::vector<int>& groups);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_CANDIDATES_H_
