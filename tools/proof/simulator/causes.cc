#include "tools/proof/simulator/causes.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace dhcal::concealed {
namespace {

std::size_t DriveIndex(int joint) { return static_cast<std::size_t>(joint) - 1; }

}  // namespace

Cause Yields(int joint, double compliance) {
  Cause cause = NamedCause("joint_compliance", joint, joint == 2 ? "C1" : "elastic");
  cause.values = {{"compliance", compliance}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].compliance += scale * compliance;
  };
  return cause;
}

Cause YieldsSoftly(int joint, double compliance, double soft_torque) {
  constexpr double kRatio = 1.3;
  Cause cause = NamedCause("joint_compliance", joint, joint == 2 ? "C1" : "elastic");
  // No single number is its compliance: none is compared.
  cause.also = {"torsion_nonlinearity"};
  cause.more =
      fmt::format("    - {{effect: torsion_nonlinearity, joint: {}, soft_torque_Nm: {:g}}}\n",
                  joint,
                  soft_torque);
  cause.apply = [=](Physics* physics, double scale) {
    Drive& drive = physics->drives[DriveIndex(joint)];
    drive.compliance += scale * compliance;
    drive.soft_torque = soft_torque;
    drive.soft_ratio = kRatio;
  };
  return cause;
}

Cause BaseYields(double compliance) {
  Cause cause = At(NamedCause("base_compliance", 0, "C1"), "base", "base");
  cause.values = {{"compliance_x", compliance}, {"compliance_y", compliance}};
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->base_compliance += scale * compliance * Eigen::Vector2d::Ones();
  };
  return cause;
}

Cause Balanced(double stiffness) {
  Cause cause = NamedCause("gravity_balancer", 2, "C2");
  cause.parameters = 4;
  cause.also = {"gear_harmonic", "joint_gain"};
  cause.like_masses = true;
  cause.apply = [=](Physics* physics, double scale) {
    physics->balancer.stiffness = scale * stiffness;
  };
  return cause;
}

Cause GearErrs(int joint, double order, double amplitude, double phase) {
  const bool mesh = order > 2;
  Cause cause = NamedCause("gear_harmonic", joint, mesh ? "C8" : joint == 2 ? "C2" : "C3");
  cause.settings = {{"order", order}};
  if (!mesh) {
    cause.values = {{fmt::format("sin_{:g}", order), amplitude * std::cos(phase)},
                    {fmt::format("cos_{:g}", order), amplitude * std::sin(phase)}};
    cause.also = {"joint_gain"};
  }
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->lines.push_back({joint - 1, order, scale * amplitude, phase});
  };
  return cause;
}

Cause Plays(int joint, double gap) {
  Cause cause = NamedCause("backlash", joint, "C4");
  // The link stays behind the motor: negative by the library's sign.
  cause.values = {{"width", -gap}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].play += scale * gap;
  };
  return cause;
}

Cause PlaysUnderLoad(int joint, double gap, double preload) {
  Cause cause = NamedCause("backlash", joint, "C4");
  cause.settings = {{"flank", 1}};
  // Near zero torque the approach decides: the change of flank is gradual, like a short soft zone.
  cause.also = {"torsion_nonlinearity"};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].play += scale * gap;
    physics->drives[DriveIndex(joint)].preload = preload;
  };
  return cause;
}

Cause WindsUp(int joint, double windup) {
  Cause cause = NamedCause("backlash", joint, "C4");
  cause.values = {{"width", -2 * windup}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].windup += scale * windup;
  };
  return cause;
}

Cause Coupled(int joint, int driver, double ratio) {
  Cause cause = NamedCause("joint_coupling", joint, "C9");
  cause.settings = {{"driver_joint", driver}};
  cause.values = {{"coupling", ratio}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->couplings.push_back({joint - 1, driver - 1, scale * ratio});
  };
  return cause;
}

Cause Gains(int joint, double gain) {
  Cause cause = NamedCause("joint_gain", joint, "C3");
  cause.values = {{"gain", gain}};
  cause.also = {"transmission_error"};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].gain += scale * gain;
  };
  return cause;
}

Cause Wobbles(int joint, double amplitude, double phase) {
  constexpr double kOrder = 2;
  Cause cause = At(NamedCause("axis_wobble", joint, ""), fmt::format("joint {}", joint), "axis");
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->wobbles.push_back({joint - 1, kOrder, scale * amplitude, phase});
  };
  return cause;
}

Cause LinkBends(int link, double flexibility) {
  Cause cause =
      At(NamedCause("link_bending", link, "elastic"), fmt::format("link {}", link), "link");
  cause.values = {{"flexibility", flexibility}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->link_flexibility[DriveIndex(link)] += scale * flexibility;
  };
  return cause;
}

}  // namespace dhcal::concealed
