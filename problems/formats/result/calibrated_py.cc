// calibrated.py: the delivered model as a Python module that needs nothing but Python.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/physics/effect.h"
#include "core/physics/registry.h"
#include "problems/formats/result/python_chain.h"
#include "problems/formats/result/python_effects.h"
#include "problems/formats/result/python_values.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

constexpr char kIntroduction[] =
    R"py(# Calibrated model of a robot, written by ceres_dhcal. It needs nothing but Python 3.
#
#   import calibrated
#   pose = calibrated.forward([0.1, -1.2, ...])            # rad (m of a prismatic joint) -> 4 x 4 [m]
#   q = calibrated.inverse(pose, start=[0.0, -1.0, ...])   # numerically, near the start
#
# As a program it prints the pose of the joint coordinates that are its arguments:
#   python3 calibrated.py 0.1 -1.2 ...
)py";

constexpr char kMain[] = R"py(

if __name__ == "__main__":
    import sys
    for line in forward([float(word) for word in sys.argv[1:]]):
        print("  ".join("%22.15e" % number for number in line))
)py";

/// Why calibrated.py cannot hold an effect; empty where it does.
std::string WhyNotHeld(const EffectRequest& request) {
  static const std::vector<std::string> held = {"joint_compliance",
                                                "torsion_nonlinearity",
                                                "gravity_balancer",
                                                "link_bending",
                                                "base_compliance",
                                                "joint_gain",
                                                "joint_coupling",
                                                "gear_harmonic",
                                                "transmission_error",
                                                "axis_wobble",
                                                "backlash"};
  if (std::find(held.begin(), held.end(), request.effect) == held.end()) {
    return "it depends on more than the pose and how it was approached";
  }
  return request.setting("measured_torque", 0) != 0 ? "it needs the measured torque" : "";
}

std::string JointOf(const JointRow& row) {
  return fmt::format(
      "{{\"name\": {}, \"type\": \"{}\", \"theta\": {}, \"d\": {}, \"a\": {}, \"alpha\": {}, "
      "\"beta\": {}, \"sign\": {}}}",
      PythonText(row.name),
      row.type == JointType::kRevolute ? "revolute" : "prismatic",
      row.theta,
      row.d,
      row.a,
      row.alpha,
      row.beta,
      row.sign);
}

std::string MassOf(const LinkMass& link) {
  return fmt::format("{{\"mass\": {}, \"com\": {}}}", link.mass, PythonValue(link.p_LC));
}

std::string EffectOf(const EffectRequest& request) {
  return fmt::format("{{\"effect\": {}, \"joint\": {}, \"settings\": {}, \"values\": {}}}",
                     PythonText(request.effect),
                     request.joint,
                     PythonValue(request.settings),
                     PythonValue(request.values));
}

std::string FrameOf(const std::string& name, const Eigen::Isometry3d& X) {
  return fmt::format("({}, {})", PythonText(name), PythonValue(X));
}

/// The frames that a run or target may have of its own, by name; else the one there is.
std::string BasesOf(const RobotModel& robot) {
  std::vector<std::string> frames;
  for (const RunFrame& base : robot.base_of_run) frames.push_back(FrameOf(base.run, base.X));
  if (!robot.base_per_run || frames.empty()) frames = {FrameOf("", robot.X_WB)};
  return PythonList(frames);
}
std::string ToolsOf(const RobotModel& robot) {
  std::vector<std::string> frames;
  for (const Target& target : robot.targets) frames.push_back(FrameOf(target.name, target.X_TQ));
  if (frames.empty() && robot.tool_per_run) {
    for (const RunFrame& tool : robot.tool_of_run) frames.push_back(FrameOf(tool.run, tool.X));
  }
  if (frames.empty()) frames = {FrameOf("", robot.X_TQ)};
  return PythonList(frames);
}

std::string DataOf(const RobotModel& robot) {
  std::vector<std::string> joints, links;
  for (const JointRow& row : robot.joints) joints.push_back(JointOf(row));
  for (const LinkMass& link : robot.links) links.push_back(MassOf(link));
  std::string text = fmt::format(
      "# Denavit-Hartenberg rows [rad, m]; a joint adds sign * q to theta (prismatic: to d).\n"
      "# standard: Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)\n"
      "# modified: Rx(alpha) Tx(a) Ry(beta) Rz(theta) Tz(d)\n"
      "MODIFIED = {}\nJOINTS = {}\n",
      robot.convention == DhConvention::kModified ? "True" : "False",
      PythonList(joints));
  text += fmt::format(
      "# Measurement frame -> base of each run, and flange -> measured point of each target or\n"
      "# run; where there is one only, it has no name.\n"
      "BASES = {}\nTOOLS = {}\n",
      BasesOf(robot),
      ToolsOf(robot));
  return text + fmt::format(
                    "# [m/s^2] in the base; masses [kg] and their centres [m] in the rows' frames, "
                    "the payload's\n# in the flange's.\n"
                    "GRAVITY = {}\nLINKS = {}\nPAYLOAD = {}\n",
                    PythonValue(robot.gravity_B),
                    PythonList(links),
                    MassOf(robot.payload));
}

}  // namespace

std::string CalibratedPython(const std::string& problem,
                             const RobotModel& calibrated,
                             const std::vector<EffectRequest>& effects) {
  std::vector<std::string> held, left_out;
  for (const EffectRequest& effect : effects) {
    // The robot stands where it would without it.
    if (FindEffect(effect.effect)->Describe().of_instrument) continue;
    const std::string why = WhyNotHeld(effect);
    if (why.empty()) {
      held.push_back(EffectOf(effect));
    } else {
      left_out.push_back(PythonText(fmt::format("{} ({})", InstanceName(effect), why)));
    }
  }
  std::string text = fmt::format(
      "{}import math\n\nNAME = {}\n{}", kIntroduction, PythonText(problem), DataOf(calibrated));
  text += fmt::format(
      "# What the rigid rows leave out, as calibrated.yaml has it; values in SI units.\n"
      "EFFECTS = {}\n"
      "# Effects of calibrated.yaml that this file cannot hold; forward() refuses to pass over "
      "them.\nLEFT_OUT = {}\n",
      PythonList(held),
      PythonList(left_out));
  return text + kPythonChain + kPythonEffects + kMain;
}

}  // namespace dhcal
