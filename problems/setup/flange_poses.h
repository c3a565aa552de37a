// The flange's poses of a few rows under any set-up, fast: no sine is computed twice.
#ifndef DHCAL_PROBLEMS_SETUP_FLANGE_POSES_H_
#define DHCAL_PROBLEMS_SETUP_FLANGE_POSES_H_

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/model/recording.h"
#include "core/model/robot.h"
#include "problems/setup/set_up.h"

namespace dhcal {

/// Rows that are looked at together at most.
constexpr int kMostSetUpRows = 64;

/// X_BT of some rows, number by number.
struct FlangePoses {
  using Numbers = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostSetUpRows, 1>;
  std::array<Numbers, 3> p;                 // [m] p_BT
  std::array<std::array<Numbers, 3>, 3> R;  // R[c][k]: component k of the flange's axis c in B
};

/// Bound to a robot and a recording, both of which must outlive it. Immutable.
class FlangeOfRows {
 public:
  /// At most kMostSetUpRows rows; `set_up.shift` is the caller's matter.
  FlangeOfRows(const RobotModel& robot, const Recording& recording, const std::vector<int>& rows);

  int num_rows() const { return num_rows_; }
  void Evaluate(const SetUp& set_up, FlangePoses* poses) const;

 private:
  using Numbers = FlangePoses::Numbers;
  /// Cosine and sine of a column in one of its units.
  struct Turn {
    Numbers cos, sin;
  };

  /// Cosine and sine of a joint's angle, or of a slide's constant theta.
  Turn AngleOf(const SetUp& set_up, int joint_idx) const;
  const Turn& TurnOf(const SetUp::Joint& joint) const {
    return turns_[static_cast<std::size_t>(joint.column)][static_cast<std::size_t>(joint.unit)];
  }

  const RobotModel& robot_;
  int num_rows_ = 0;
  std::vector<std::array<Turn, 3>> turns_;  // per column and AngleUnit
  std::vector<Numbers> coordinates_;        // per column
};

/// What a number is times, where it holds radians under the name of degrees or the reverse.
double FactorOf(AngleUnit unit);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_FLANGE_POSES_H_
