// Rows that are one draw of the robot, read several times.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_REPEATS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_REPEATS_H_

#include <vector>

#include <Eigen/Core>

#include "core/model/recording.h"

namespace dhcal {

/// The recording with the repeats of a pose put together (means; of the readings medians), where
/// few poses were read often: a pose read ten times is one draw of the robot, not ten. Rows of
/// another run, target, anchor, payload or set stay apart; so do the visits of a pose that was left
/// in between, where they are too few to tell or tell that something went by the clock: what moves
/// from one visit to the next would be gone from a mean of them. Differences are left as they are.
struct DistinctRows {
  Recording recording;
  std::vector<std::vector<int>> original;  // rows of the original recording in each row
  bool averaged = false;
};
/// `direction`: of each joint's last motion in the controller's sense, rows x n (0 = not known).
DistinctRows PutRepeatsTogether(const Recording& recording, const Eigen::MatrixXd& direction);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_REPEATS_H_
