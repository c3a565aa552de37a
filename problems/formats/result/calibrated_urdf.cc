// calibrated.urdf: the robot description that ROS loads, with the calibrated geometry.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/physics/effect.h"
#include "core/physics/registry.h"
#include "problems/formats/result/result_writer.h"
#include "problems/formats/urdf/urdf_chain.h"
#include "problems/formats/urdf/urdf_corrected.h"
#include "problems/formats/urdf/urdf_tree.h"

namespace dhcal {
namespace {

/// Found or given: none of them has a place in a URDF.
std::vector<std::string> LeftOut(const std::vector<EffectRequest>& effects) {
  std::vector<std::string> lines;
  for (const EffectRequest& effect : effects) {
    if (FindEffect(effect.effect)->Describe().of_instrument) continue;
    std::string values;
    for (const auto& [name, value] : effect.values) {
      values += fmt::format("{}{} {:.4g}", values.empty() ? "" : ", ", name, value);
    }
    lines.push_back(fmt::format("  {}{}",
                                InstanceName(effect),
                                values.empty() ? "" : fmt::format(" ({}, SI units)", values)));
  }
  return lines;
}

}  // namespace

std::string CalibratedUrdf(const ProblemSpec& spec,
                           const Result& result,
                           Diagnostics* diagnostics) {
  if (!spec.urdf) return "";
  Diagnostics found;
  std::vector<std::string> remarks = {"Origins of the joints corrected by ceres_dhcal from " +
                                      std::filesystem::path(spec.file).filename().string() +
                                      "; the rest is as it was."};
  const std::vector<std::string> left_out =
      LeftOut(result.delivered ? result.delivered->effects : spec.parameters.effects);
  if (!left_out.empty()) {
    remarks.emplace_back(
        "What the robot does beside, which no URDF can hold (calibrated.yaml does):");
    remarks.insert(remarks.end(), left_out.begin(), left_out.end());
  }
  const RobotModel& robot = !result.delivered         ? result.calibrated
                            : result.delivered->rigid ? *result.delivered->rigid
                                                      : result.delivered->robot;
  std::optional<std::string> text;
  if (const auto tree = ParseUrdf(spec.urdf->file, spec.urdf->text, &found)) {
    const auto chain =
        FindUrdfChain(*tree, {spec.urdf->base_link, spec.urdf->tip_link, {}, {}}, &found);
    if (chain) text = CorrectedUrdf(*tree, *chain, robot, remarks, &found);
  }
  for (const Diagnostic& message : found.all()) {
    if (message.severity != Severity::kError) continue;
    diagnostics->Warning(message.where, "no calibrated.urdf is written: " + message.message);
  }
  return text.value_or("");
}

}  // namespace dhcal
