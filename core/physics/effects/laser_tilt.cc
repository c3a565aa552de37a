// Slant of one laser: its beam does not point where the file says.
//
//   u -> u + w x u,  d height = -height (w x u).z / u.z          w [rad], two components
//
// about two axes across the beam: the tool's x (y of a beam near x) without its part along the
// beam, and that axis turned by 90 deg about the beam. A slant that all three sensors have in
// common is the tool's pose. Typical: 1-5 mrad. Source: PHYSICS.md S7. Worked number: w =
// 1 mrad lifts a beam of -16.31 m by 8.4e-6, u.z = 0.0364: 3.8 mm of laser 1, 0.78 mm in base_z.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

/// The tool's x axis, or y of a beam near x, without its part along the beam.
Eigen::Vector3d AcrossOf(const Eigen::Vector3d& beam) {
  constexpr double kNearX = 0.9;
  const Eigen::Vector3d axis =
      std::abs(beam.x()) < kNearX ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return (axis - axis.dot(beam) * beam).normalized();
}

class LaserTiltEffect final : public EffectOfLaser {
 public:
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const HeadRows rows(c);
    const int laser = LaserIndex(request);
    const auto k = static_cast<std::size_t>(laser);
    const Eigen::Vector3d beam = c.robot().head->lasers[k].axis;
    const Eigen::Vector3d first = AcrossOf(beam);
    const auto column = [&](const std::string& name, const Eigen::Vector3d& about) {
      const Eigen::Vector3d slant = about.cross(beam);
      return rows.Column(fmt::format("{}_laser{}", name, laser + 1),
                         "rad",
                         1e-3,
                         [&](int row, const HeadSights& seen) {
                           const Sight& sight = seen.lasers[k];
                           const double lifted = c.X_WQ(row).linear().row(2).dot(slant);
                           Eigen::Vector3d error = Eigen::Vector3d::Zero();
                           error[laser + 1] = -sight.length * lifted * sight.length_by_plane();
                           return error;
                         });
    };
    return {column("first", first), column("second", beam.cross(first))};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C10", "sensor", "tilt"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const int laser = LaserIndex(request) + 1;
    const auto angle = [&](const char* const name) {
      return Quantity(Find(values, fmt::format("{}_laser{}", name, laser)), 1e-3, "mrad");
    };
    return fmt::format(
        "the beam of laser {} is slanted by {} and {} about the tool's axes across it",
        laser,
        angle("first"),
        angle("second"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "laser_tilt";
    example.request.settings["laser"] = 1;
    example.request.values["second_laser1"] = 1e-3;
    example.row = 1;
    example.slot = "base_z";
    example.expected = 0.0007791171382310492;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"laser_tilt",
            "the beam of a laser points elsewhere than the file says",
            "d height = -height (w x u).z / u.z",
            "first_laser<k> [rad], second_laser<k> [rad]",
            {{"laser", "1 or 2"}},
            "measurement kind straight_edge",
            "1-5 mrad [PHYSICS.md S7]"};
  }
};

}  // namespace

const Effect& LaserTilt() {
  static const LaserTiltEffect effect;
  return effect;
}

}  // namespace dhcal
