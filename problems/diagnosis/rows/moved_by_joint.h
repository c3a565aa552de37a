// Readings that lie off because a joint stands where it does: a damaged tooth, a dent of a bearing.
// Misreadings are spread over the joint's range and point anywhere; these are together at one of
// its places, and off along its own motion. No model of the library holds them, so they stay out of
// the fit, but a verdict must not pass over them.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MOVED_BY_JOINT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MOVED_BY_JOINT_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

/// How often misreadings of a recording look so.
constexpr double kChanceOfAPlace = 1e-3;

/// One joint at every reading.
struct JointAtReadings {
  Eigen::VectorXd place;   // where it stands [rad or m]
  Eigen::VectorXd motion;  // whitened derivative of the readings, coordinate by coordinate
};

/// Of the readings that lie `off`, which joint (position in `joints`; -1 = none) moved each at one
/// of its places: more of them are within a range of its places than chance puts there once in a
/// thousand recordings, all ranges and joints taken together; or all of them, if only a few, are at
/// one place. `residuals`: whitened, coordinate by coordinate.
std::vector<int> MovedByAJoint(const std::vector<JointAtReadings>& joints,
                               const Eigen::VectorXd& residuals,
                               const std::vector<bool>& off);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MOVED_BY_JOINT_H_
