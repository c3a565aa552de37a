#include "tools/proof/simulator/random/random_files.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "tools/proof/simulator/arm_yaml.h"
#include "tools/proof/simulator/random/random_recording.h"

namespace dhcal::concealed {
namespace {

using Eigen::Isometry3d;
using Json = nlohmann::ordered_json;

/// The base is level: turned about the vertical only.
std::string BaseYaml(const RandomTrial& trial) {
  const Isometry3d& base = trial.drawing.base;
  const double heading = std::atan2(base.linear()(1, 0), base.linear()(0, 0));
  return fmt::format("  base: {{xyz_m: {}, rpy_deg: [0, 0, {:.9g}]{}}}\n",
                     YamlList(base.translation()),
                     heading / kDegree,
                     trial.settings.setups == Setups::kStated ? ", per_run: true" : "");
}

std::string ToolYaml(const Arm& arm) {
  if (arm.targets.empty()) {
    return fmt::format("  tool: {{xyz_m: {}}}\n", YamlList(arm.tool.translation()));
  }
  std::string text = "  targets:\n";
  for (int k = 0; k < arm.num_targets(); ++k) {
    text +=
        fmt::format("    {}: {{xyz_m: {}}}\n", LetterOf(k), YamlList(arm.target(k).translation()));
  }
  return text;
}

std::string ReadingsYaml(const RandomTrial& trial) {
  const Settings& s = trial.settings;
  std::string text = fmt::format("measurement:\n  kind: {}\n", ToString(s.kind));
  if (s.kind == Kind::kAdjacent) {
    text += fmt::format("  noise: {}\n", s.shared_pose ? "shared_pose" : "independent");
  }
  if (s.sigma != Said::kNothing) {
    text += fmt::format("  sigma_mm: {:.6g}\n", s.sigma_factor * s.noise / kMillimetre);
    if (s.kind == Kind::kPose) {
      text +=
          fmt::format("  sigma_rotation_mrad: {:.6g}\n", s.sigma_factor * s.noise_rotation * 1e3);
    }
  }
  if (s.kind != Kind::kDistance) return text;
  text += "  anchors:\n";
  for (std::size_t k = 0; k < trial.anchors.size(); ++k) {
    text += fmt::format(
        "    {}: {{xyz_m: {}}}\n", LetterOf(static_cast<int>(k)), YamlList(trial.anchors[k]));
  }
  return text;
}

std::string RandomProblem(const RandomTrial& trial, const std::string& hash) {
  const Arm& arm = trial.drawing;
  return fmt::format(
             "# A random case: the recording of an arm of which this file does not say all.\n"
             "# sha256 of the sealed answer: {}\n"
             "schema: 1\nname: random\nrobot:\n  name: {}\n  convention: {}\n",
             hash,
             arm.title,
             arm.convention == Convention::kStandard ? "standard" : "modified") +
         JointsYaml(arm) + BaseYaml(trial) + ToolYaml(arm) +
         (trial.settings.masses == Said::kNothing ? "" : MassesYaml(trial.stated)) +
         ReadingsYaml(trial) +
         fmt::format(
             "recording: recording.csv\nparameters:\n  estimate: {}\n"
             "diagnosis: {{run: always}}\n",
             trial.settings.complete ? "[complete]" : "[theta, alpha, a, d]");
}

Json SettingsToJson(const RandomTrial& trial) {
  const Settings& s = trial.settings;
  const std::string kind =
      s.kind != Kind::kAdjacent
          ? ToString(s.kind)
          : fmt::format("adjacent_position, {}", s.shared_pose ? "shared" : "independent");
  return {{"estimate", s.complete ? "complete" : "[theta, alpha, a, d]"},
          {"kind", kind},
          {"robot", s.robot},
          {"decimals", std::to_string(s.decimals)},
          {"repeats", std::to_string(s.repeats)},
          {"targets", std::to_string(s.targets)},
          {"tail", ToString(s.tail)},
          {"slow noise", s.wandering > 0 ? "yes" : "no"},
          {"outliers", fmt::format("{:g} %", 100 * s.outliers)},
          {"sigma", ToString(s.sigma)},
          {"masses", ToString(s.masses)},
          {"order", ToString(s.order)},
          {"rows", std::to_string(trial.motion.num_poses())},
          {"test rows", s.test_rows ? "yes" : "no"},
          {"instrument", s.far ? "far" : "near"},
          {"columns", std::to_string(trial.columns.size())},
          {"setups", ToString(s.setups)}};
}

Json RandomCauseToJson(const Cause& cause) {
  Json same = Json::array();
  for (const auto& [effect, joint] : cause.same) {
    same.push_back({{"effect", effect}, {"joint", joint}});
  }
  return {{"effect", cause.effect},
          {"joint", cause.joint},
          {"settings", cause.settings},
          {"words", cause.words},
          {"values", cause.values},
          {"location", cause.location},
          {"slot", cause.slot},
          {"also", cause.also},
          {"same", same},
          {"raw_sigmas", cause.visibility.raw_rms},
          {"visible_sigmas", cause.visibility.visible_rms},
          {"lambda", cause.visibility.lambda},
          {"power", cause.visibility.power}};
}

std::string RandomAnswer(const RandomTrial& trial, const std::string& name) {
  Json answer = {{"name", name},
                 {"scenario", "R"},
                 {"seed", trial.seed},
                 {"noise_m", trial.settings.noise},
                 {"settings", SettingsToJson(trial)},
                 {"geometry", trial.geometry},
                 {"causes", Json::array()}};
  for (const Cause& cause : trial.causes) answer["causes"].push_back(RandomCauseToJson(cause));
  // Whoever knows the causes must not find the answer by trying their hashes.
  Rng rng(trial.seed * 86028121 + 5);
  answer["salt"] = fmt::format("{:.17g}", rng.Uniform(0, 1));
  return answer.dump(1) + "\n";
}

}  // namespace

std::string NameOfRandom(int seed) { return fmt::format("R_{:05}", seed); }

CaseFiles FilesOf(const RandomTrial& trial) {
  CaseFiles files;
  files.name = NameOfRandom(static_cast<int>(trial.seed));
  files.answer = RandomAnswer(trial, files.name);
  files.problem = RandomProblem(trial, Sha256(files.answer));
  files.recording = RandomRecordingCsv(trial);
  return files;
}

}  // namespace dhcal::concealed
