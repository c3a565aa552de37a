// Torsional compliance of a joint: gravity turns it by c tau.
//
//   d theta_j = c tau_j(q, payload)          c = 1/k [rad/(N m)], tau_j [N m]
//
// tau_j is gravity's torque about the joint's axis in DH's sense, so a real c is positive. With
// `links` the parameter is c. Without, tau is linear in unknown moments: one parameter per minimal
// moment, each the product c x moment, and c itself only from a payload that changes. The setting
// free_masses = 1 does so although masses are given (they may be wrong). With the setting
// measured_torque = 1, tau is the recording's torque column.
// Typical: 2-6e5 N m/rad at joints 2 and 3 of a 15 kg arm (c = 2-5 urad/(N m)), 1-5e4 in its wrist.
// Source: PHYSICS.md E1; rigidity of RV-20E/40E/80E gears 49/108/196 N m/arcmin.
// Worked number: 100 N m at 3e-6 rad/(N m) turn the joint by 0.3 mrad.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr double kTypicalMain = 3e-6;    // [rad/(N m)] joints 1 to 3
constexpr double kTypicalWrist = 30e-6;  // [rad/(N m)]
constexpr double kMicro = 1e-6;

double Typical(int joint) { return joint < 3 ? kTypicalMain : kTypicalWrist; }

bool UsesMeasuredTorque(const EffectRequest& request) {
  return request.setting("measured_torque", 0) != 0;
}

bool FreesMasses(const EffectRequest& request) { return request.setting("free_masses", 0) != 0; }

class JointComplianceEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"joint_compliance",
            "a joint yields elastically under the torque of gravity and payload",
            "d theta_j = c tau_j",
            "compliance [rad/(N m)]; without masses compliance_x_<moment>",
            {{"measured_torque", "1 = use the torque column"},
             {"free_masses", "1 = do not trust robot.links"}},
            "robot.links for c itself; torque<j>_Nm with measured_torque",
            "2-6 urad/(N m) at joints 1-3, 20-100 in the wrist [PHYSICS.md E1]"};
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    const int joint = JointIndex(request);
    if (UsesMeasuredTorque(request)) {
      if (!HasMeasuredTorque(c, joint)) return "the recording has no torque of this joint";
      return IsConstant(c.recording().torque.col(joint)) ? "the joint's torque is constant" : "";
    }
    return GravityLoads(c, joint) ? "" : "gravity does not load this joint";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    if (UsesMeasuredTorque(request)) {
      return {SlotColumn(
          "compliance", "rad/(N m)", Typical(joint), c.joint_slot(joint), MeasuredLoad(c, joint))};
    }
    std::vector<EffectColumn> columns;
    const double typical = Typical(joint) * SoftnessOfSize(c);
    for (const MassCase& mass_case :
         FreesMasses(request) ? FreeMassCases(c, joint) : MassCases(c, joint)) {
      const bool known = mass_case.name.empty();
      columns.push_back(SlotColumn(known ? "compliance" : "compliance_x_" + mass_case.name,
                                   known ? "rad/(N m)" : "rad/(N m) " + mass_case.unit,
                                   typical * mass_case.typical,
                                   c.joint_slot(joint),
                                   GravityTorque(c, mass_case, joint)));
      columns.back().positive = known;
    }
    return columns;
  }

  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    return WithVariant(*this, c, EveryJoint(c, "joint_compliance"), "measured_torque");
  }

  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    const bool shoulder = JointIndex(request) == FirstLoadedJoint(c);
    return {shoulder ? "C1" : "elastic",
            JointName(request.joint),
            UsesMeasuredTorque(request) ? "measured torque" : "gravity torque"};
  }
  bool DependsOnPoseOnly(const EffectRequest& request) const override {
    return !UsesMeasuredTorque(request);
  }

  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue c = Find(values, "compliance");
    const char* const load = UsesMeasuredTorque(request) ? "its measured torque" : "gravity load";
    if (c.sigma > 0) {
      return fmt::format("{} is compliant: {} under {}",
                         JointWords(context, request.joint),
                         Quantity(c, kMicro, "urad/(N m)"),
                         load);
    }
    std::string text = fmt::format(
        "{} is compliant under gravity load; {}, so only products with the compliance are known: ",
        JointWords(context, request.joint),
        FreesMasses(request) ? "its load is not known" : "the masses are not given");
    for (std::size_t k = 0; k < values.size(); ++k) {
      const EffectValue& value = values[k];
      const std::string moment = value.parameter.substr(std::string("compliance_x_").size());
      const bool mass = moment.find("mass") != std::string::npos;
      text += (k > 0 ? ", " : "") + moment + " " +
              Quantity(value, kMicro, mass ? "urad/(N m) kg" : "urad/(N m) kg m");
    }
    return text;
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "joint_compliance";
    example.request.joint = 2;
    example.request.settings["measured_torque"] = 1;
    example.request.values["compliance"] = 3e-6;
    example.row = 1;
    example.slot = "theta2";
    // The column's sign is that of gravity, which pulls the stretched arm of row 1 down (-).
    example.expected = -3e-4;
    return example;
  }
};

}  // namespace

const Effect& JointCompliance() {
  static const JointComplianceEffect effect;
  return effect;
}

}  // namespace dhcal
