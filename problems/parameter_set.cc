#include "problems/parameter_set.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "core/analysis/null_space.h"
#include "core/base/units.h"
#include "core/kinematics/slots.h"
#include "core/model/joint_numbers.h"

namespace dhcal {
namespace {

Parameter MakeParameter(const SlotLayout& slots, int slot, ParameterGroup group) {
  Parameter parameter;
  parameter.name = slots.Name(slot);
  parameter.group = group;
  parameter.unit = slots.is_angle(slot) ? Unit::kRadian : Unit::kMetre;
  parameter.slot = slot;
  parameter.tolerance = DefaultTolerance(group, parameter.unit);
  return parameter;
}

/// The copies of a frame: one of each run, edge or target; without suffixes one for all rows.
struct FrameCopies {
  ParameterScope::Kind scope = ParameterScope::Kind::kRun;
  std::vector<std::string> suffixes;
};

void AddFrame(const SlotLayout& slots,
              ParameterGroup group,
              const FrameCopies& copies,
              std::vector<Parameter>* all) {
  const int first_slot = group == ParameterGroup::kBase ? slots.base(0) : slots.tool(0);
  const std::size_t count = std::max<std::size_t>(copies.suffixes.size(), 1);
  for (std::size_t copy = 0; copy < count; ++copy) {
    for (int component = 0; component < SlotLayout::kPerFrame; ++component) {
      Parameter parameter = MakeParameter(slots, first_slot + component, group);
      if (!copies.suffixes.empty()) {
        parameter.name += "." + copies.suffixes[copy];
        parameter.scope = {copies.scope, static_cast<int>(copy)};
      }
      all->push_back(parameter);
    }
  }
}

std::vector<Parameter> AllParameters(const RobotModel& robot, const Recording& recording) {
  const SlotLayout slots(robot.num_joints());
  std::vector<Parameter> all;
  for (const JointNumber& number : kJointNumbers) {
    for (int joint = 0; joint < robot.num_joints(); ++joint) {
      all.push_back(MakeParameter(slots, slots.joint(joint, number.slot), number.group));
    }
  }
  FrameCopies runs{ParameterScope::Kind::kRun, recording.run_names};
  if (runs.suffixes.empty()) runs.suffixes = {"1"};
  FrameCopies bases;
  if (robot.base_per_run) bases = runs;
  if (robot.base_per_edge) bases = {ParameterScope::Kind::kEdge, recording.edge_names};
  AddFrame(slots, ParameterGroup::kBase, bases, &all);
  FrameCopies tools{ParameterScope::Kind::kTarget, {}};
  for (const Target& target : robot.targets) tools.suffixes.push_back(target.name);
  if (robot.tool_per_run) tools = runs;
  AddFrame(slots, ParameterGroup::kTool, tools, &all);
  return all;
}

/// "tool_z.A" -> "tool_z".
std::string WithoutScope(const std::string& name) { return name.substr(0, name.find('.')); }

bool Names(const std::string& entry, const Parameter& parameter) {
  return entry == parameter.name || entry == WithoutScope(parameter.name) ||
         entry == ToString(parameter.group);
}

bool IsListed(const std::vector<std::string>& entries,
              const std::vector<int>& needs_beta,
              const Parameter& parameter) {
  for (const std::string& entry : entries) {
    if (Names(entry, parameter)) return true;
    if (entry != "complete") continue;
    if (parameter.group != ParameterGroup::kBeta) return true;
    const int joint = SlotLayout::JointOf(parameter.slot);
    if (std::find(needs_beta.begin(), needs_beta.end(), joint) != needs_beta.end()) return true;
  }
  return false;
}

/// The most particular entry wins: full name, name without scope, group.
void SetPrior(const std::map<std::string, double>& priors, Parameter* parameter) {
  std::string group = ToString(parameter->group);
  if (parameter->group == ParameterGroup::kBase || parameter->group == ParameterGroup::kTool) {
    group += parameter->unit == Unit::kMetre ? ":m" : ":rad";
  }
  for (const std::string& key : {parameter->name, WithoutScope(parameter->name), group}) {
    const auto found = priors.find(key);
    if (found == priors.end()) continue;
    parameter->prior_sigma = found->second;
    return;
  }
}

}  // namespace

double DefaultTolerance(ParameterGroup group, Unit unit) {
  if (const JointNumber* const number = NumberOf(group)) return number->tolerance;
  if (group == ParameterGroup::kEffect) return 0;  // its own, EffectParameter
  // Base and tool: after the closed-form alignment; what set-up leaves is found from the readings.
  return unit == Unit::kMetre ? 5 * kMillimetre : 5 * kMilliradian;
}

double CorrectionLimit(const Parameter& parameter) {
  if (parameter.group == ParameterGroup::kBase || parameter.group == ParameterGroup::kEffect) {
    return std::numeric_limits<double>::infinity();
  }
  return 1.0;  // [rad] or [m]
}

Parameter EffectParameter(const EffectRequest& request,
                          const EffectColumn& column,
                          int column_idx) {
  // An effect may well be ten times its typical size; the tolerance only decides what is worth
  // estimating.
  constexpr double kTypicalToTolerance = 10;
  Parameter parameter;
  parameter.name = ParameterName(request, column.parameter);
  parameter.group = ParameterGroup::kEffect;
  parameter.unit = Unit::kOther;
  parameter.unit_text = column.unit;
  parameter.effect_column = column_idx;
  parameter.tolerance = kTypicalToTolerance * column.typical;
  if (column.prior_sigma > 0) parameter.prior_sigma = column.prior_sigma;
  return parameter;
}

std::vector<int> JointsThatNeedBeta(const RobotModel& robot) {
  std::vector<int> joints;
  for (int joint = 0; joint + 1 < robot.num_joints(); ++joint) {
    if (AxesParallel(robot, joint, joint + 1)) {
      joints.push_back(static_cast<int>(robot.row_between(joint)));
    }
  }
  return joints;
}

ParameterSet ResolveParameters(const ProblemSpec& spec, const Recording& recording) {
  const std::vector<int> needs_beta = JointsThatNeedBeta(spec.robot);
  ParameterSet set;
  for (Parameter& parameter : AllParameters(spec.robot, recording)) {
    SetPrior(spec.parameters.prior_sigma, &parameter);
    const bool estimated = IsListed(spec.parameters.estimate, needs_beta, parameter) &&
                           !IsListed(spec.parameters.fix, needs_beta, parameter);
    // A beta that nobody asked for is no part of a plain DH row: not worth a line in the report.
    if (!estimated && parameter.group == ParameterGroup::kBeta &&
        spec.robot.joints[static_cast<std::size_t>(SlotLayout::JointOf(parameter.slot))].beta ==
            0) {
      continue;
    }
    (estimated ? set.estimated : set.fixed).push_back(parameter);
  }
  return set;
}

}  // namespace dhcal
