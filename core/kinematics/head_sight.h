// What a head reads at a pose over a straight edge, and how that changes with the pose.
//
// E: x along the rulings, z out of the flat face. A sensor at S looks along the unit vector u (both
// fixed in the tool frame Q) and meets a plane z = c where
//   t(X) = (c - p_ES.z) / u.z                  length of its sight [m]
//   ruler = (p_ES + t u).x                     camera; c: the ruled face
//   height = t                                 lasers; c = 0: the flat face
// English et al. (2004), "Measurement concept".
#ifndef DHCAL_CORE_KINEMATICS_HEAD_SIGHT_H_
#define DHCAL_CORE_KINEMATICS_HEAD_SIGHT_H_

#include <array>
#include <optional>

#include <Eigen/Core>

#include "core/model/head.h"

namespace dhcal {

/// What a sensor sees of a plane z = c. Derivatives are by the twist (d p_EQ [m], turn w [rad],
/// both in E) of Q, 1 x 6.
struct Sight {
  using Row = Eigen::Matrix<double, 1, 6>;

  Eigen::Vector3d u = Eigen::Vector3d::Zero();   // along the sight, in E
  double length = 0;                             // [m]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // [m] where it meets the plane, in E
  Row length_by = Row::Zero();
  Row ruler_by = Row::Zero();  // d at.x

  /// What a plane that stands higher by 1 does to the length, and to at.x.
  double length_by_plane() const { return 1 / u.z(); }
  double ruler_by_plane() const { return u.x() / u.z(); }
};

/// The sights of camera, laser 1 and laser 2 at a pose, and the numbers that they read.
struct HeadSights {
  using TwistRows = Eigen::Matrix<double, 3, 6>;

  Sight camera;
  std::array<Sight, 2> lasers;

  Eigen::Vector3d numbers() const {  // ruler, height1, height2 [m]
    return {camera.at.x(), lasers[0].length, lasers[1].length};
  }
  TwistRows by_twist() const {
    return (TwistRows() << camera.ruler_by, lasers[0].length_by, lasers[1].length_by).finished();
  }
};

/// Q stands at p_EQ [m], turned by R_EQ. Nothing where a sensor looks along the faces.
std::optional<HeadSights> SightsOf(const HeadSpec& head,
                                   const Eigen::Vector3d& p_EQ,
                                   const Eigen::Matrix3d& R_EQ);

}  // namespace dhcal

#endif  // DHCAL_CORE_KINEMATICS_HEAD_SIGHT_H_
