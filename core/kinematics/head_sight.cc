#include "core/kinematics/head_sight.h"

#include <cmath>

namespace dhcal {
namespace {

// A sensor that looks along the faces to this sine sees nothing.
constexpr double kGrazing = 1e-3;

std::optional<Sight> Look(const HeadSensor& sensor,
                          const Eigen::Vector3d& p_EQ,
                          const Eigen::Matrix3d& R_EQ,
                          double plane) {
  const Eigen::Vector3d p_QS_E = R_EQ * sensor.p_QS;
  Sight sight;
  sight.u = R_EQ * sensor.axis;
  if (std::abs(sight.u.z()) < kGrazing) return std::nullopt;
  sight.length = (plane - p_EQ.z() - p_QS_E.z()) / sight.u.z();
  const Eigen::Vector3d p_QM_E = p_QS_E + sight.length * sight.u;
  sight.at = p_EQ + p_QM_E;
  // The twist moves the point of the sight that is at M by t + w x p_QM; M stays in the plane.
  Sight::Row x_by, z_by;
  x_by << 1, 0, 0, 0, p_QM_E.z(), -p_QM_E.y();
  z_by << 0, 0, 1, p_QM_E.y(), -p_QM_E.x(), 0;
  sight.length_by = -z_by / sight.u.z();
  sight.ruler_by = x_by + sight.u.x() * sight.length_by;
  return sight;
}

}  // namespace

std::optional<HeadSights> SightsOf(const HeadSpec& head,
                                   const Eigen::Vector3d& p_EQ,
                                   const Eigen::Matrix3d& R_EQ) {
  const std::optional<Sight> camera = Look(head.camera, p_EQ, R_EQ, head.ruler_height);
  if (!camera) return std::nullopt;
  HeadSights sights;
  sights.camera = *camera;
  for (std::size_t k = 0; k < head.lasers.size(); ++k) {
    const std::optional<Sight> laser = Look(head.lasers[k], p_EQ, R_EQ, 0);
    if (!laser) return std::nullopt;
    sights.lasers[k] = *laser;
  }
  return sights;
}

}  // namespace dhcal
