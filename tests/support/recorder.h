// Makes recordings with the independent kinematics: truth from outside the code under test.
#ifndef DHCAL_TESTS_SUPPORT_RECORDER_H_
#define DHCAL_TESTS_SUPPORT_RECORDER_H_

#include <string>
#include <vector>

#include "core/base/rng.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// A robot whose rows, base and tool differ from its nominal ones.
struct TrueRobot {
  RobotModel nominal;
  Eigen::VectorXd delta;                                   // slot errors
  Eigen::Isometry3d X_VW = Eigen::Isometry3d::Identity();  // instrument V to nominal W

  /// Pose of the measured point in the instrument's frame.
  Eigen::Matrix4d Pose(const Eigen::VectorXd& q) const;
};

/// Errors of a usual size: 1 mrad and 0.3 mm on rows (no beta where axes are not parallel), and an
/// instrument that stands anywhere.
TrueRobot MakeTrueRobot(const RobotModel& nominal, std::uint64_t seed);

/// A problem that estimates the complete geometry from readings of this kind.
ProblemSpec MakeSpec(const RobotModel& nominal, const MeasurementKind& kind, NoiseKind noise);

struct RecordingPlan {
  int poses = 150;
  double sigma = 20e-6;           // [m]
  double sigma_rotation = 50e-6;  // [rad]
  std::uint64_t seed = 1;
};

/// Random poses read as the spec's kind asks.
Recording Record(const TrueRobot& robot, const ProblemSpec& spec, const RecordingPlan& plan);

/// RMS over new random poses of what the calibrated robot predicts against the truth [m]: 3-D
/// position, displacement from pose to pose for adjacent_position, distances for distance.
double PredictionError(const TrueRobot& truth,
                       const ProblemSpec& spec,
                       const RobotModel& calibrated,
                       std::uint64_t seed);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_RECORDER_H_
