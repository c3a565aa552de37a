// Where a calibration's model has the tool at joint coordinates that were not recorded, and how
// that depends on what was estimated.
#ifndef DHCAL_PROBLEMS_TASK_POINTS_H_
#define DHCAL_PROBLEMS_TASK_POINTS_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/calibration.h"

namespace dhcal {

struct PredictedPoints {
  Eigen::Matrix3Xd p_WQ;  // [m], one column per pose
  Eigen::MatrixXd J;      // 3 poses x parameters: d p_WQ / d parameter, the three rows of each pose
                          // together
  std::vector<std::string> left_out;  // effects that depend on more than the pose
};

/// At a state of the calibration, for the first run, target and edge; `q`: poses x joints.
PredictedPoints PointsAt(const Calibration& calibration,
                         const Eigen::VectorXd& state,
                         const Eigen::MatrixXd& q);

/// Takes out of columns over points (3 points x any) what a rigid motion of all points does.
Eigen::MatrixXd WithoutMotion(const Eigen::Matrix3Xd& points, const Eigen::MatrixXd& columns);

/// True where the readings know no base that all rows share (one per edge or run, differences):
/// errors are then those beside a rigid motion of the region.
bool KnowsNoCommonBase(const ProblemSpec& spec);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_TASK_POINTS_H_
