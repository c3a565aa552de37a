// Where the accuracy of a robot matters, and what a calibration lets expect there.
#ifndef DHCAL_CORE_MODEL_TASK_H_
#define DHCAL_CORE_MODEL_TASK_H_

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Corners of a box with edges along the axes of the base B [m].
struct TaskBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();

  bool Holds(const Eigen::Vector3d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

/// A box, or poses.
struct TaskSpec {
  std::optional<TaskBox> box;
  Eigen::MatrixXd q;  // poses x joints [rad or m] as the controller counts; empty with a box
  std::string file;   // that they were read from
  SourceLocation where;
};

/// Root of the mean square over a region [m], 3-D, with the 95 % interval.
struct RegionError {
  double rms = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// Errors of the predicted position at poses of a task. They are those of the model's parameters:
/// neither the robot's repeatability is in them nor what the model leaves out.
struct TaskError {
  std::string region;    // in words: "300 poses in the box ..."
  std::string unknown;   // why there are no numbers, as a sentence; else empty
  int poses = -1;        // that stand for the region
  bool aligned = false;  // errors after the region as a whole was moved to fit best: where the
                         // readings know no base that all of them share
  RegionError before;    // of the nominal robot, base and tool fitted
  RegionError after;     // of the calibrated one, by what the readings determine
  double after_largest = std::numeric_limits<double>::quiet_NaN();  // [m] at the worst pose
  /// [m] RMS that directions which no reading determines add where they are off by their priors or
  /// tolerances.
  double hidden = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> left_out;  // effects that depend on more than the pose
  Eigen::MatrixXd q;                  // the poses, as in TaskSpec
  Eigen::Matrix3Xd p_nominal;         // [m] where the nominal robot is there; kept for other fits
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_TASK_H_
