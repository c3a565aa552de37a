// A measuring head with faults, written apart from the effects: bent surfaces that sights are
// followed to, turned beams, a camera that measures from the nearest ruling.
#ifndef DHCAL_TESTS_SUPPORT_FAULTY_HEAD_H_
#define DHCAL_TESTS_SUPPORT_FAULTY_HEAD_H_

#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/model/head.h"

namespace dhcal::independent {

/// Zero everywhere = none. Distances along the edge count from `middle`, heights from `height0`.
struct HeadFaults {
  double curvature = 0;  // [1/m] of both faces
  double climb = 0;      // [rad] of the ruled face
  double higher = 0;     // [m] the ruled face
  double pixel = 0;      // [1]
  double middle = 0;     // [m]
  std::array<double, 2> height0 = {0, 0};
  std::array<Eigen::Vector3d, 2> slant = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<Eigen::Vector3d, 2> polynomial = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// Ruler, height1, height2 [m] of a head at X_EQ; `ruler0` [m]: what the ruler says at x = 0.
inline Eigen::Vector3d FaultyNumbers(const HeadSpec& head,
                                     const HeadFaults& faults,
                                     const Eigen::Isometry3d& X_EQ,
                                     double ruler0 = 0) {
  const auto bow = [&](double x) { return faults.curvature * std::pow(x - faults.middle, 2) / 2; };
  const auto flat = [&](double x) { return bow(x); };
  const auto ruled = [&](double x) {
    return head.ruler_height + faults.higher + faults.climb * (x - faults.middle) + bow(x);
  };
  // Bisection: the sight's end is above the face on one side and below it on the other.
  const auto follow = [](const Eigen::Vector3d& from, const Eigen::Vector3d& along, auto face) {
    double near = 0, far = -3 * from.z() / along.z();
    for (int turn = 0; turn < 200; ++turn) {
      const double middle = (near + far) / 2;
      const Eigen::Vector3d at = from + middle * along;
      const bool above = (at.z() > face(at.x())) == (from.z() > face(from.x()));
      (above ? near : far) = middle;
    }
    return (near + far) / 2;
  };
  const Eigen::Vector3d eye = X_EQ * head.camera.p_QS;
  const Eigen::Vector3d sight = X_EQ.linear() * head.camera.axis;
  const double mark = ruler0 + eye.x() + sight.x() * follow(eye, sight, ruled);
  Eigen::Vector3d numbers(mark, 0, 0);
  if (head.pitch) {
    const double offset = mark - *head.pitch * std::floor(mark / *head.pitch + 0.5);
    numbers[0] += faults.pixel * offset;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::Vector3d about = faults.slant[k];
    const Eigen::Vector3d beam =
        Eigen::AngleAxisd(
            about.norm(),
            about.norm() > 0 ? Eigen::Vector3d(about.normalized()) : Eigen::Vector3d(1, 0, 0)) *
        head.lasers[k].axis;
    const double height = follow(X_EQ * head.lasers[k].p_QS, X_EQ.linear() * beam, flat);
    const double t = height - faults.height0[k];
    const Eigen::Vector3d& c = faults.polynomial[k];
    numbers[static_cast<Eigen::Index>(k) + 1] = height + ((c[2] * t + c[1]) * t + c[0]) * t;
  }
  return numbers;
}

}  // namespace dhcal::independent

#endif  // DHCAL_TESTS_SUPPORT_FAULTY_HEAD_H_
