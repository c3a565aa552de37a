// How finely a recording says where the joints stood, and which rows are of one pose.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_READ_OUT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_READ_OUT_H_

#include <vector>

#include <Eigen/Core>

#include "core/model/recording.h"
#include "core/model/robot.h"

namespace dhcal {

/// A column whose values need as many is exact as far as any arm is.
constexpr int kExactDecimals = 6;
/// Fewest decimals that hold all values, blank ones (NaN) apart; kExactDecimals where there are
/// more.
int DecimalsOf(const Eigen::VectorXd& values);

/// Last digit of each joint's column [rad or m], read from its values: the fewest decimals, of
/// degrees or millimetres, that hold all of them. 0 where they have six or more: then the column is
/// exact as far as any arm is. 0, too, where the values are those of a grid, or whole degrees or
/// millimetres: they were commanded, not read.
Eigen::VectorXd ReadOutQuanta(const Recording& recording, const RobotModel& robot);

/// A number per row; rows with the same one have equal joint coordinates within the read-out (a
/// parked joint's jitter included).
std::vector<int> PosesOfRows(const Recording& recording);

/// The recording with the repeats of a pose put together (means; of the readings medians), where
/// few poses were read often: a pose read ten times is one draw of the robot, not ten. Rows of
/// another run, target, anchor, payload or set stay apart. Differences are left as they are.
struct DistinctRows {
  Recording recording;
  std::vector<std::vector<int>> original;  // rows of the original recording in each row
  bool averaged = false;
};
/// `direction`: of each joint's last motion in the controller's sense, rows x n (0 = not known).
DistinctRows PutRepeatsTogether(const Recording& recording, const Eigen::MatrixXd& direction);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_READ_OUT_H_
