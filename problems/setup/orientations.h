// Whether measured orientations follow the robot, and in which form they would.
#ifndef DHCAL_PROBLEMS_SETUP_ORIENTATIONS_H_
#define DHCAL_PROBLEMS_SETUP_ORIENTATIONS_H_

#include <array>
#include <optional>

#include "problems/calibration.h"

namespace dhcal {

/// [rad] RMS: orientations that are the robot's; no instrument reads worse.
constexpr double kFollowsRobot = 0.05;

/// A form in which four numbers may hold an orientation.
struct QuaternionForm {
  std::array<int, 4> order = {0, 1, 2, 3};  // w, x, y, z stand in these columns
  bool inverse = false;                     // of W in Q, not of Q in W
  /// The frame of the orientations is turned against that of the positions.
  bool turned = false;
  double misfit = 0;  // [rad] RMS of the angle that is left
};

/// How the orientations of the fitted rows fit as they are written, and the form in which they fit
/// best; base and tool of the calibration are those that its positions show. Nothing with fewer
/// than four orientations of a run.
struct OrientationForms {
  QuaternionForm as_written, best;
};
std::optional<OrientationForms> JudgeOrientations(const Calibration& calibration);

/// The quaternions (rows x 4) read in another form.
Eigen::MatrixXd InForm(const Eigen::MatrixXd& quaternions, const QuaternionForm& form);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_ORIENTATIONS_H_
