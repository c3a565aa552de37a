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

/// What the last digit of each joint's column leaves open [rad or m]; 0 = the column is exact.
struct ReadOut {
  /// Of a column that was read: every row has a rounding of its own.
  Eigen::VectorXd quantum;
  /// Of a column of few places that do not fit their last digit (-66.67, -33.33, 0, ...): what was
  /// rounded off a place comes back wherever the joint stops at it, as an error of its gear would.
  Eigen::VectorXd level;
  /// The one or the other.
  Eigen::VectorXd last_digit() const { return quantum + level; }
};

/// Reads the last digit from a column's values: the fewest decimals, of degrees or millimetres,
/// that hold all of them. Six or more are exact as far as any arm is; so are whole degrees or
/// millimetres, and places a whole number of some step apart: they were commanded, not read.
ReadOut ReadOutOf(const Recording& recording, const RobotModel& robot);

/// A number per row; rows with the same one have equal joint coordinates within the read-out (a
/// parked joint's jitter included).
std::vector<int> PosesOfRows(const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_READ_OUT_H_
