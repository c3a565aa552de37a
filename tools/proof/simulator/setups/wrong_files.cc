#include "tools/proof/simulator/setups/wrong_files.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/io/csv_text.h"
#include "tools/proof/simulator/arm_yaml.h"
#include "tools/proof/simulator/random/draw.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/random_readings.h"
#include "tools/proof/simulator/setups/mistakes.h"

namespace dhcal::concealed {
namespace {

using Json = nlohmann::ordered_json;

/// A plain recording: one run, one target, nothing left out.
RandomTrial DrawTrial(int seed, Rng* rng) {
  const std::vector<std::string> robots = {"kr15", "ur10", "small", "modified", "seven", "scara"};
  RandomTrial trial;
  trial.seed = static_cast<std::uint64_t>(seed);
  Settings& s = trial.settings;
  s.robot = DrawFrom(robots, rng);
  s.kind =
      s.robot == "scara" ? Kind::kPosition : static_cast<Kind>(DrawIndex({0.7, 0.2, 0, 0.1}, rng));
  s.shared_pose = true;
  s.far = true;
  s.noise = DrawLogUniform(10e-6, 100e-6, rng);
  s.rows = static_cast<int>(std::lround(DrawLogUniform(30, 300, rng)));
  s.clock = false;
  s.order = Order::kRandom;
  trial.drawing = DrawArm(s, rng);
  trial.built = AsBuilt(trial.drawing, rng);
  trial.motion = DrawMotion(s, trial.drawing, rng);
  return trial;
}

void MakeMistakes(WrongFiles* files, Rng* rng) {
  std::vector<MistakeSource> sources = MistakeSources(*files);
  sources.erase(std::remove_if(sources.begin(),
                               sources.end(),
                               [](const MistakeSource& source) { return !source.possible; }),
                sources.end());
  const std::size_t count = 1 + DrawIndex({0.5, 0.3, 0.2}, rng);
  std::vector<bool> drawn(sources.size(), false);
  for (std::size_t k = 0; k < count; ++k) {
    drawn[static_cast<std::size_t>(DrawInt(static_cast<int>(sources.size()), rng))] = true;
  }
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (drawn[k]) sources[k].make(files, rng);
  }
}

std::string TableYaml(const WrongFiles& files) {
  std::string text = "  joints:\n";
  for (const DrawnLink& link : files.table.links) {
    text +=
        fmt::format("    - {{theta_deg: {:.9g}, d_m: {:.9g}, a_m: {:.9g}, alpha_deg: {:.9g}{}}}\n",
                    link.theta * files.angle_unit,
                    link.d * files.length_unit,
                    link.a * files.length_unit,
                    link.alpha * files.angle_unit,
                    link.slides ? ", type: prismatic" : "");
  }
  return text;
}

std::string ProblemOf(const WrongFiles& files, const std::string& hash) {
  const Settings& s = files.trial.settings;
  return fmt::format(
             "# A random case whose files may say something that is not so.\n"
             "# sha256 of the sealed answer: {}\n"
             "schema: 1\nname: wrong_files\nrobot:\n  convention: {}\n",
             hash,
             files.table.convention == Convention::kStandard ? "standard" : "modified") +
         TableYaml(files) +
         fmt::format(
             "  tool: {{xyz_m: {}}}\nmeasurement:\n  kind: {}\n{}recording: recording.csv\n"
             "parameters:\n  estimate: [complete]\ndiagnosis: {{run: never}}\n",
             YamlList(files.tool_unit * files.table.tool.translation()),
             ToString(s.kind),
             s.kind == Kind::kAdjacent ? "  noise: shared_pose\n" : "");
}

std::string RecordingOf(const WrongFiles& files) {
  CsvText csv;
  const Eigen::Index n = files.q.cols();
  for (Eigen::Index j = 0; j < n; ++j) {
    csv.Label(fmt::format("q{}_{}", j + 1, files.joint_ending[static_cast<std::size_t>(j)]));
  }
  for (const char axis : {'x', 'y', 'z'}) {
    csv.Label(fmt::format("{}_{}", axis, files.reading_ending));
  }
  const bool pose = files.trial.settings.kind == Kind::kPose;
  for (const char axis : {'w', 'x', 'y', 'z'}) {
    if (pose) csv.Label(fmt::format("q{}", axis));
  }
  csv.EndRow();
  for (Eigen::Index row = 0; row < files.q.rows(); ++row) {
    for (Eigen::Index j = 0; j < n; ++j) {
      csv.Label(
          fmt::format("{:.6f}", files.q(row, j) * files.joint_unit[static_cast<std::size_t>(j)]));
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      csv.Label(fmt::format("{:.7g}", files.readings(row, k) * files.reading_unit));
    }
    for (std::size_t k = 0; pose && k < 4; ++k) {
      csv.Label(fmt::format("{:.7f}", files.readings(row, 3 + files.quaternion[k])));
    }
    csv.EndRow();
  }
  return csv.Take();
}

std::string AnswerOf(const WrongFiles& files, const std::string& name) {
  Json answer = {{"name", name},
                 {"robot", files.trial.settings.robot},
                 {"kind", ToString(files.trial.settings.kind)},
                 {"rows", files.q.rows()},
                 {"mistakes", Json::array()}};
  for (const Mistake& mistake : files.mistakes) {
    answer["mistakes"].push_back({{"kind", mistake.kind}, {"joints", mistake.joints}});
  }
  Rng rng(files.trial.seed * 86028121 + 11);
  answer["salt"] = fmt::format("{:.17g}", rng.Uniform(0, 1));
  return answer.dump(1) + "\n";
}

}  // namespace

std::string NameOfWrongFiles(int seed) { return fmt::format("S_{:05}", seed); }

WrongFiles MakeWrongFiles(int seed, bool with_mistakes) {
  constexpr std::uint64_t kStream = 104729;  // apart from that of the random trials
  Rng rng(static_cast<std::uint64_t>(seed) * 1000003 + kStream);
  WrongFiles files;
  files.trial = DrawTrial(seed, &rng);
  files.table = files.trial.drawing;
  files.q = files.trial.motion.q;
  files.readings = RandomReadings(files.trial);
  files.angle_unit = 1 / kDegree;
  for (const DrawnLink& link : files.table.links) {
    files.joint_unit.push_back(link.slides ? 1 / kMillimetre : 1 / kDegree);
    files.joint_ending.emplace_back(link.slides ? "mm" : "deg");
  }
  if (with_mistakes) MakeMistakes(&files, &rng);
  return files;
}

CaseFiles FilesOf(const WrongFiles& wrong) {
  CaseFiles files;
  files.name = NameOfWrongFiles(static_cast<int>(wrong.trial.seed));
  files.answer = AnswerOf(wrong, files.name);
  files.problem = ProblemOf(wrong, Sha256(files.answer));
  files.recording = RecordingOf(wrong);
  return files;
}

}  // namespace dhcal::concealed
