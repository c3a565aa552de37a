#include "tools/proof/simulator/case_files.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glog/logging.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include "core/base/units.h"
#include "core/io/csv_text.h"
#include "tools/proof/simulator/arm_yaml.h"

namespace dhcal::concealed {
namespace {

using Json = nlohmann::ordered_json;

std::string RobotYaml(const Arm& arm) {
  return fmt::format("robot:\n  name: {}\n  convention: standard\n", arm.title) + JointsYaml(arm) +
         fmt::format("  tool: {{xyz_m: {}}}\n", YamlList(arm.tool.translation())) + MassesYaml(arm);
}

std::string MeasurementYaml(const Trial& trial) {
  if (trial.head) return HeadYaml(*trial.head, trial.sigma_given);
  std::string text = fmt::format("measurement:\n  kind: {}\n",
                                 trial.differences ? "adjacent_position" : "position");
  if (trial.differences) text += "  noise: shared_pose\n";
  if (trial.sigma_given)
    text += fmt::format("  sigma_mm: {:.6g}\n", trial.sensor.noise / kMillimetre);
  return text;
}

/// What a problem file says besides robot and measurement.
struct Task {
  std::string name;
  std::string comment;  // whole lines, above all else
  std::string estimate = "[complete]";
  std::string effects;  // whole lines
  std::string diagnosis = "{run: never}";
};

std::string ProblemYaml(const Trial& trial, const Task& task) {
  return fmt::format(
      "{}schema: 1\nname: {}\n{}{}recording: recording.csv\nparameters:\n"
      "  estimate: {}\n{}diagnosis: {}\n",
      task.comment,
      task.name,
      RobotYaml(trial.drawing),
      MeasurementYaml(trial),
      task.estimate,
      task.effects,
      task.diagnosis);
}

std::string EffectsYaml(const Trial& trial) {
  if (trial.causes.empty()) return "";
  std::string text = "  effects:\n";
  for (const Cause& cause : trial.causes) {
    text += fmt::format("    - {{effect: {}", cause.effect);
    if (cause.joint > 0) text += fmt::format(", joint: {}", cause.joint);
    for (const auto& [key, value] : cause.settings)
      text += fmt::format(", {}: {:.12g}", key, value);
    text += "}\n" + cause.more;
  }
  return text;
}

bool LibraryHasAll(const Trial& trial) {
  for (const Cause& cause : trial.causes) {
    if (cause.effect.empty()) return false;
  }
  return true;
}

Json CauseToJson(const Cause& cause) {
  Json object = {{"effect", cause.effect},
                 {"joint", cause.joint},
                 {"settings", cause.settings},
                 {"values", cause.values},
                 {"class", cause.effect_class},
                 {"location", cause.location},
                 {"slot", cause.slot},
                 {"also", cause.also},
                 {"raw_rms_m", cause.visibility.raw_rms},
                 {"visible_rms_m", cause.visibility.visible_rms},
                 {"lambda", cause.visibility.lambda},
                 {"power", cause.visibility.power}};
  return object;
}

std::string Answer(const Trial& trial, const std::string& name) {
  Json answer = {{"name", name},
                 {"scenario", trial.scenario},
                 {"story", trial.story},
                 {"group", ToString(trial.group)},
                 {"robot", trial.drawing.name},
                 {"seed", trial.seed},
                 {"noise_m", trial.sensor.noise},
                 {"scale_is_wrong", trial.scale_is_wrong},
                 {"causes", Json::array()}};
  for (const Cause& cause : trial.causes) answer["causes"].push_back(CauseToJson(cause));
  if (trial.group == Group::kConcealed) {
    const Elsewhere elsewhere = TrueErrorElsewhere(trial);
    answer["rms_elsewhere_m"] = elsewhere.rms;
    answer["largest_elsewhere_m"] = elsewhere.largest;
  }
  if (LibraryHasAll(trial)) {
    Task oracle;
    oracle.name = name + "_oracle";
    oracle.effects = EffectsYaml(trial);
    answer["oracle_problem"] = ProblemYaml(trial, oracle);
  }
  // Whoever knows the scenarios must not find the answer by trying their hashes.
  Rng rng(trial.seed * 104729 + 71);
  answer["salt"] = fmt::format("{:.17g}", rng.Uniform(0, 1));
  return answer.dump(1) + "\n";
}

std::string RecordingCsv(const Trial& trial) {
  const Eigen::MatrixXd readings = Readings(trial);
  const Motion& motion = trial.motion;
  const bool moving = motion.speed.rows() > 0;
  const bool runs = !trial.head && motion.run.front() != motion.run.back();
  CsvText csv;
  for (Eigen::Index j = 1; j <= motion.q.cols(); ++j) csv.Label(fmt::format("q{}_deg", j));
  for (const char* const axis : {"x", "y", "z"}) {
    if (!trial.head) csv.Label(fmt::format("{}{}_mm", trial.differences ? "d" : "", axis));
  }
  if (trial.head) {
    for (const char* const name : {"ruler_mm", "height1_mm", "height2_mm", "edge"}) csv.Label(name);
  }
  csv.Label("t_s");
  if (runs) csv.Label("run");
  if (motion.payload_varies) csv.Label("payload_kg");
  for (Eigen::Index j = 1; moving && j <= motion.q.cols(); ++j)
    csv.Label(fmt::format("qd{}_deg_s", j));
  csv.Label("set");
  csv.EndRow();
  // Displayed digits: a ten-thousandth of a degree, a micrometre.
  const auto rounded = [](double value, double unit) { return std::round(value / unit) * unit; };
  for (int row = 0; row < motion.num_poses(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    const bool first = row == 0 || motion.run[i] != motion.run[i - 1];
    for (Eigen::Index j = 0; j < motion.q.cols(); ++j) {
      csv.Number(rounded(motion.q(row, j) / kDegree, 1e-4));
    }
    for (int k = 0; k < 3; ++k) {
      if (!trial.differences) {
        csv.Number(rounded(readings(row, k) / kMillimetre, 1e-3));
      } else if (first) {
        csv.Blank();
      } else {
        csv.Number(rounded((readings(row, k) - readings(row - 1, k)) / kMillimetre, 1e-3));
      }
    }
    if (trial.head) csv.Label(fmt::format("E{:02}", motion.run[i]));
    csv.Number(motion.time[row]);
    if (runs) csv.Label(fmt::format("r{}", motion.run[i]));
    if (motion.payload_varies) csv.Number(motion.payload[row]);
    for (Eigen::Index j = 0; moving && j < motion.q.cols(); ++j) {
      csv.Number(motion.speed(row, j) / kDegree);
    }
    csv.Label(motion.test[i] ? "test" : "train");
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace

std::string Sha256(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  CHECK_EQ(EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr), 1);
  std::string hex;
  for (unsigned int k = 0; k < size; ++k) hex += fmt::format("{:02x}", digest[k]);
  return hex;
}

CaseFiles FilesOf(const Trial& trial) {
  CaseFiles files;
  files.name = fmt::format("{}_{}_{:02}", trial.scenario, trial.drawing.name, trial.seed);
  files.answer = Answer(trial, files.name);
  const std::string head = fmt::format(
      "# A concealed case: the recording of an arm of which this file does not say all.\n"
      "# sha256 of the sealed answer: {}\n",
      Sha256(files.answer));
  // The name of the case would give the scenario away to the program; the folder has it.
  files.problem = ProblemYaml(trial, {"concealed", head, trial.estimate, "", "{run: always}"});
  files.recording = RecordingCsv(trial);
  return files;
}

}  // namespace dhcal::concealed
