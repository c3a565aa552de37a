// Nonlinear torsion of a gear: stiffer under load than around zero torque.
//
//   d theta_j = c3 tau_j^3                   c3 [rad/(N m)^3], tau_j [N m] gravity's torque
//   d theta_j = c1 max(-T, min(tau_j, T))    c1 [rad/(N m)], with the setting soft_torque_Nm = T
//
// Added to joint_compliance it describes the soft zone of harmonic drives and cycloid gears (three
// stiffness regions K1 < K2 < K3): smoothly, with c3 < 0 beside c > 0, or as the makers state it,
// with the torque T up to which the gear is softer by c1. A small T is lost motion: play that
// gravity takes up (backlash with flank = 1) looks the same, so its class is that of play. Needs
// masses: neither is linear in unknown moments. Typical: K2/K1 = 1.3-1.6, so c3 tau^2 is about -0.1
// c at the largest torque. Source: PHYSICS.md G4. Worked number: row 2 of the example, tau_3 = 0 N
// m carried: see the conformance test.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr char kSoftTorque[] = "soft_torque_Nm";
constexpr double kShortZone = 0.15;  // of the largest torque

Eigen::VectorXd Torque(const PhysicsContext& c, const EffectRequest& request) {
  const int joint = JointIndex(request);
  return request.setting("measured_torque", 0) != 0
             ? MeasuredLoad(c, joint)
             : GravityTorque(c, MassCases(c, joint).front(), joint);
}

/// A soft zone so short that it cannot be told from play that gravity takes up.
bool IsLostMotion(const PhysicsContext& c, const EffectRequest& request) {
  const double end = request.setting(kSoftTorque, 0);
  return end > 0 && end < kShortZone * Torque(c, request).cwiseAbs().maxCoeff();
}

class TorsionNonlinearityEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"torsion_nonlinearity",
            "a gear is softer around zero torque than under load",
            "d theta_j = c3 tau_j^3, or c1 max(-T, min(tau_j, T))",
            "cubic [rad/(N m)^3]; soft [rad/(N m)] with soft_torque_Nm",
            {{"soft_torque_Nm", "T, end of the soft zone"},
             {"measured_torque", "1 = use the torque column"}},
            "robot.links, or torque<j>_Nm with measured_torque",
            "a tenth of the linear yield at the largest torque [PHYSICS.md G4]"};
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    const int joint = JointIndex(request);
    if (request.setting("measured_torque", 0) != 0) {
      return HasMeasuredTorque(c, joint) ? "" : "the recording has no torque of this joint";
    }
    if (c.robot().links.empty()) return "the masses (robot.links) are not given";
    return GravityLoads(c, joint) ? "" : "gravity does not load this joint";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const Eigen::VectorXd torque = Torque(c, request);
    if (const double end = request.setting(kSoftTorque, 0); end > 0) {
      return {SlotColumn("soft",
                         "rad/(N m)",
                         1e-6 * SoftnessOfSize(c),
                         c.joint_slot(joint),
                         torque.cwiseMin(end).cwiseMax(-end))};
    }
    const double largest = std::max(torque.cwiseAbs().maxCoeff(), 1.0 / SoftnessOfSize(c));
    // A twentieth of a milliradian at the largest torque.
    const double typical = 5e-5 / (largest * largest * largest);
    return {SlotColumn(
        "cubic", "rad/(N m)^3", typical, c.joint_slot(joint), torque.array().cube().matrix())};
  }

  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> candidates =
        WithVariant(*this, c, EveryJoint(c, "torsion_nonlinearity"), "measured_torque");
    const std::size_t cubes = candidates.size();
    for (std::size_t k = 0; k < cubes; ++k) {
      const EffectRequest cube = candidates[k];
      if (!NotTestable(c, cube).empty()) continue;
      const double largest = Torque(c, cube).cwiseAbs().maxCoeff();
      for (const double share : {0.05, 0.15, 0.4}) {
        candidates.push_back(cube);
        candidates.back().settings[kSoftTorque] = share * largest;
      }
    }
    return candidates;
  }

  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    const bool lost_motion = IsLostMotion(c, request);
    const bool shoulder = JointIndex(request) == FirstLoadedJoint(c);
    return {lost_motion ? "C4"
            : shoulder  ? "C1"
                        : "elastic",
            JointName(request.joint),
            "gravity torque"};
  }
  bool DependsOnPoseOnly(const EffectRequest& request) const override {
    return request.setting("measured_torque", 0) == 0;
  }

  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    if (const double end = request.setting(kSoftTorque, 0); end > 0) {
      return fmt::format(
          "{} is softer by {} below {:.3g} N m (close to zero load it cannot be told from "
          "backlash)",
          JointWords(context, request.joint),
          Quantity(Find(values, "soft"), 1e-6, "urad/(N m)"),
          end);
    }
    // Nobody knows a usual number of radians per cubed newton metre.
    const double largest = Torque(context, request).cwiseAbs().maxCoeff();
    EffectValue twist = Find(values, "cubic");
    twist.value *= std::pow(largest, 3);
    twist.sigma *= std::pow(largest, 3);
    return fmt::format(
        "{} is twisted in proportion to the cube of its torque, by {} at its largest of {:.3g} N m "
        "({})",
        JointWords(context, request.joint),
        Quantity(twist, 1e-6, "urad"),
        largest,
        twist.value < 0 ? "stiffer under load" : "softer under load");
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "torsion_nonlinearity";
    example.request.joint = 2;
    example.request.settings["measured_torque"] = 1;
    example.request.values["cubic"] = -1e-10;
    example.row = 1;
    example.slot = "theta2";
    example.expected = 1e-4;  // (-100 N m)^3 x -1e-10
    return example;
  }
};

}  // namespace

const Effect& TorsionNonlinearity() {
  static const TorsionNonlinearityEffect effect;
  return effect;
}

}  // namespace dhcal
