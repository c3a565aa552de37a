#include "tools/proof/simulator/causes.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace dhcal::concealed {
namespace {

Cause Named(const std::string& effect, int joint, const std::string& effect_class) {
  Cause cause;
  cause.effect = effect;
  cause.joint = joint;
  cause.effect_class = effect_class;
  cause.location = fmt::format("joint {}", joint);
  cause.slot = fmt::format("theta{}", joint);
  return cause;
}

Cause At(Cause cause, const std::string& location, const std::string& slot) {
  cause.location = location;
  cause.slot = slot;
  return cause;
}

std::size_t DriveIndex(int joint) { return static_cast<std::size_t>(joint) - 1; }

/// A column that warms link 1 and then link 2: the order in which the heat goes.
void AddBody(Physics* physics, const ThermalBody& body) {
  const auto place = body.link == 1 ? physics->thermal.begin() : physics->thermal.end();
  physics->thermal.insert(place, body);
}

}  // namespace

Cause Yields(int joint, double compliance) {
  Cause cause = Named("joint_compliance", joint, joint == 2 ? "C1" : "elastic");
  cause.values = {{"compliance", compliance}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].compliance += scale * compliance;
  };
  return cause;
}

Cause YieldsSoftly(int joint, double compliance, double soft_torque) {
  constexpr double kRatio = 1.3;
  Cause cause = Named("joint_compliance", joint, joint == 2 ? "C1" : "elastic");
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
  Cause cause = At(Named("base_compliance", 0, "C1"), "base", "base");
  cause.values = {{"compliance_x", compliance}, {"compliance_y", compliance}};
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->base_compliance += scale * compliance * Eigen::Vector2d::Ones();
  };
  return cause;
}

Cause Balanced(double stiffness) {
  Cause cause = Named("gravity_balancer", 2, "C2");
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
  Cause cause = Named("gear_harmonic", joint, mesh ? "C8" : joint == 2 ? "C2" : "C3");
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
  Cause cause = Named("backlash", joint, "C4");
  // The link stays behind the motor: negative by the library's sign.
  cause.values = {{"width", -gap}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].play += scale * gap;
  };
  return cause;
}

Cause PlaysUnderLoad(int joint, double gap, double preload) {
  Cause cause = Named("backlash", joint, "C4");
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
  Cause cause = Named("backlash", joint, "C4");
  cause.values = {{"width", -2 * windup}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].windup += scale * windup;
  };
  return cause;
}

Cause Coupled(int joint, int driver, double ratio) {
  Cause cause = Named("joint_coupling", joint, "C9");
  cause.settings = {{"driver_joint", driver}};
  cause.values = {{"coupling", ratio}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->couplings.push_back({joint - 1, driver - 1, scale * ratio});
  };
  return cause;
}

Cause FirstLinkGrows(double strain, double lag) {
  Cause cause = At(Named("link_thermal", 1, "C5"), "link 1", "d1");
  cause.settings = {{"time_constant_s", lag}};
  cause.values = {{"strain", strain}};
  cause.apply = [=](Physics* physics, double scale) {
    ThermalBody body;
    body.link = 1;
    body.strain = scale * strain;
    body.lag = lag;
    AddBody(physics, body);
  };
  return cause;
}

Cause SecondLinkGrows(double strain, double lag) {
  Cause cause = At(Named("link_thermal", 2, "C5"), "link 2", "a2");
  cause.settings = {{"time_constant_s", lag}};
  // Behind link 1 where that warms, too: no single exponential, so no size is compared.
  cause.apply = [=](Physics* physics, double scale) {
    ThermalBody body;
    body.link = 2;
    body.strain = scale * strain;
    body.lag = lag;
    AddBody(physics, body);
  };
  return cause;
}

Cause ToolSlips(int at_row, double time, const Eigen::Vector3d& shift) {
  Cause cause = At(Named("tool_step", 0, "C6"), "tool", "tool");
  cause.settings = {{"at_s", time}};
  cause.values = {{"x", shift.x()}, {"y", shift.y()}, {"z", shift.z()}};
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    Step step;
    step.joint = -1;
    step.at_row = at_row;
    step.shift = scale * shift;
    physics->steps.push_back(step);
  };
  return cause;
}

Cause JointSlips(int joint, int at_row, double time, double angle) {
  Cause cause = Named("joint_step", joint, "C6");
  cause.settings = {{"at_s", time}};
  cause.values = {{"step", angle}};
  cause.apply = [=](Physics* physics, double scale) {
    Step step;
    step.joint = joint - 1;
    step.at_row = at_row;
    step.angle = scale * angle;
    physics->steps.push_back(step);
  };
  return cause;
}

Cause Late(double seconds) {
  Cause cause = At(Named("latency", 0, "timing"), "sensor", "theta");
  cause.values = {{"time", seconds}};
  cause.apply = [=](Physics* physics, double scale) { physics->latency += scale * seconds; };
  return cause;
}

Cause ToothDamaged(int joint, double at, double width, double depth) {
  Cause cause = Named("", joint, "");
  // Outside the library as a mechanism, yet a curve of the joint's own angle.
  cause.also = {"transmission_error"};
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].form = [=](double q) {
      return std::abs(q - at) < width / 2
                 ? scale * depth * 0.5 * (1 + std::cos(2 * 3.14159265358979 * (q - at) / width))
                 : 0.0;
    };
  };
  return cause;
}

Cause Kinked(int joint, double at, double slope) {
  Cause cause = Named("", joint, "");
  // Outside the library as a mechanism, yet a curve of the joint's own angle.
  cause.also = {"transmission_error"};
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->drives[DriveIndex(joint)].form = [=](double q) {
      return scale * slope * std::abs(q - at);
    };
  };
  return cause;
}

Cause CablePulls(int joint, int first, int second, double amount) {
  Cause cause = Named("", joint, "");
  cause.apply = [=](Physics* physics, double scale) {
    physics->cross = [=](int which, const Eigen::VectorXd& q) {
      return which == joint - 1 ? scale * amount * q[first - 1] * q[second - 1] : 0.0;
    };
  };
  return cause;
}

Cause FloorSways(const Eigen::Vector3d& amplitude, double period) {
  Cause cause = At(Named("", 0, ""), "base", "base");
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    physics->sway += scale * amplitude;
    physics->sway_period = period;
  };
  return cause;
}

}  // namespace dhcal::concealed
