// Yielding of the base or floor: the whole robot tilts under its overturning moment.
//
//   rotation of the base (phi_x, phi_y) = (C_x M_x, C_y M_y)        [rad], C [rad/(N m)]
//
// M: gravity's moment about the base's origin, in base axes. Gravity has none about an axis that it
// is along: of a robot on a wall the base turns about two others, C_z among them. A static tilt is
// geometry (base_rx, base_ry). Equal C_x = C_y (a round pedestal) looks much like compliance of
// joint 2; unequal ones are seen by turning joint 1. Typical: 1e-8-1e-7 rad/(N m) bolted to
// concrete, 1e-7-1e-6 on a steel frame. Source: PHYSICS.md E4. Worked number: row 0 of the example
// has M_y = +665 N m; 1e-7 rad/(N m) tilt it by 66.5 urad.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr double kTypicalCompliance = 3e-7;  // [rad/(N m)]
constexpr double kAlong = 0.34;              // sine of 20 deg, from an axis to gravity

constexpr const char* kNames[] = {"compliance_x", "compliance_y", "compliance_z"};

/// Axes of the base about which gravity turns it.
std::vector<int> TurnedAxes(const PhysicsContext& c) {
  std::vector<int> axes;
  const Eigen::Vector3d down = c.robot().gravity_B.normalized();
  for (int axis = 0; axis < 3; ++axis) {
    if (down.cross(Eigen::Vector3d::Unit(axis)).norm() > kAlong) axes.push_back(axis);
  }
  return axes;
}

class BaseComplianceEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"base_compliance",
                        "base or floor tilts under the robot's overturning moment",
                        "(phi_x, phi_y) = (C_x M_x, C_y M_y)",
                        "compliance_x, compliance_y (on a wall compliance_z) [rad/(N m)]; without "
                        "masses as many products per moment",
                        {},
                        "robot.links for C itself",
                        "0.01-1 urad/(N m) [PHYSICS.md E4]"};
    d.has_joint = false;
    return d;
  }

  std::string NotTestable(const PhysicsContext& c,
                          const EffectRequest& /*request*/) const override {
    return FirstLoadedJoint(c) >= 0 ? "" : "gravity does not load any joint";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    std::vector<EffectColumn> columns;
    const double typical = kTypicalCompliance * SoftnessOfSize(c);
    const std::vector<int> axes = TurnedAxes(c);
    for (const MassCase& mass_case : MassCases(c, FirstLoadedJoint(c))) {
      const bool known = mass_case.name.empty();
      for (const int axis : axes) {
        const std::string name = kNames[axis];
        columns.push_back(TwistColumn(c,
                                      known ? name : name + "_x_" + mass_case.name,
                                      known ? "rad/(N m)" : "rad/(N m) " + mass_case.unit,
                                      typical * mass_case.typical,
                                      [&](int row) {
                                        const Load load = GravityLoad(
                                            c, mass_case, row, 0, Eigen::Vector3d::Zero());
                                        Twist twist;
                                        twist.rotation[axis] = load.moment[axis];
                                        return twist;
                                      }));
        columns.back().positive = known;
      }
    }
    return columns;
  }

  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C1", "base", "overturning moment"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }

  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    std::vector<std::string> turns;
    for (const char* const name : kNames) {
      const EffectValue value = Find(values, name);
      if (value.sigma <= 0) continue;
      turns.push_back(fmt::format("{} about {}{}",
                                  Quantity(value, 1e-6, "urad/(N m)"),
                                  turns.empty() ? "its " : "",
                                  name[std::strlen(name) - 1]));
      if (turns.size() == 1) turns.back() += " axis";
    }
    if (turns.empty()) {
      return "the base tilts under the robot's weight (the masses are not known, so only products "
             "with its compliance are)";
    }
    return fmt::format("the base tilts under the robot's overturning moment, {}",
                       fmt::join(turns, " and "));
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "base_compliance";
    example.request.values["compliance_y"] = 1e-7;
    example.row = 0;
    example.slot = "base_ry";
    // Links of 100 N each at x = 0.3, 0.95, 1.105 m (links 1, 2, 3) and 1.105 m (links 4, 5, 6).
    example.expected = 1e-7 * 100 * (0.3 + 0.95 + 4 * 1.105);
    return example;
  }
};

}  // namespace

const Effect& BaseCompliance() {
  static const BaseComplianceEffect effect;
  return effect;
}

}  // namespace dhcal
