#include "tools/proof/setup_suite.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "tools/proof/case_run.h"
#include "tools/proof/simulator/random/random_files.h"
#include "tools/proof/simulator/random/random_trial.h"
#include "tools/proof/simulator/setups/wrong_files.h"
#include "tools/proof/wilson.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kFitsAsWell = 1.15;  // times the misfit of the files as they should be

/// The program's result of a problem, whatever its exit status; discarded where it wrote none.
Json ResultOf(const fs::path& program, const CasePaths& paths) {
  RunCase(program, paths.problem, paths.result, paths.log);
  return ReadJson(paths.result / "result.json");
}

double FramesMisfit(const Json& result) {
  const Json baseline = result.value("baseline", Json::object());
  const Json frames = baseline.value("base_and_tool_only", Json::object());
  return frames.value("rms_point_m", frames.value("rms_m", 0.0));
}

std::string Words(const std::string& kind, std::vector<int> joints) {
  std::sort(joints.begin(), joints.end());
  std::string text = kind;
  for (const int joint : joints) text += " " + std::to_string(joint);
  return text;
}

/// Frames that moved between runs are told of right files, too: that is no accusation.
bool AccusesRightFiles(const Json& result) {
  const Json& setup = result["setup"];
  const Json& causes = setup["causes"];
  return !setup.value("plausible", true) ||
         std::any_of(causes.begin(), causes.end(), [](const Json& cause) {
           return cause.value("kind", "") != "frame_per_run";
         });
}

SetupScore ProveWrong(const ProofOptions& options, int seed) {
  const std::string name = concealed::NameOfWrongFiles(seed);
  const CasePaths wrong(options.folder, name), right(options.folder, name + "_right");
  if (!IsMade(wrong)) {
    WriteCase(concealed::FilesOf(concealed::MakeWrongFiles(seed)), wrong);
    WriteCase(concealed::FilesOf(concealed::MakeWrongFiles(seed, false)), right);
  }
  const Json of_right = ResultOf(options.program, right);
  const Json of_wrong = ResultOf(options.program, wrong);
  SetupScore score;
  score.name = name;
  if (of_right.is_discarded() || of_wrong.is_discarded()) {
    score.failure = "no result.json; see " + wrong.log.string();
    return score;
  }
  Json answer;
  if (const std::string why = OpenAnswer(wrong, &answer); !why.empty()) {
    score.failure = why;
    return score;
  }
  score = ScoreSetup(answer, of_wrong, FramesMisfit(of_right));
  score.accused = AccusesRightFiles(of_right);
  return score;
}

SetupScore ProveRight(const ProofOptions& options, int seed) {
  const std::string name = concealed::NameOfRandom(seed);
  const CasePaths paths(options.folder, name);
  if (!IsMade(paths)) {
    WriteCase(concealed::FilesOf(concealed::MakeRandomTrial(seed)), paths);
  }
  SetupScore score;
  score.name = name;
  const Json result = ResultOf(options.program, paths);
  Json answer;
  score.failure = OpenAnswer(paths, &answer);
  if (result.is_discarded()) score.failure = "no result.json; see " + paths.log.string();
  if (!score.failure.empty()) return score;
  score.accused = AccusesRightFiles(result);
  score.robot = answer["settings"].value("robot", "");
  score.plausible = result["setup"].value("plausible", true);
  for (const Json& cause : result["setup"]["causes"]) {
    score.claimed.push_back(Words(cause["kind"], cause["joints"]));
  }
  return score;
}

bool HasMistakes(const SetupScore& score) { return !score.mistakes.empty(); }

template <typename Predicate>
int CountOf(const std::vector<SetupScore>& scores, Predicate holds) {
  return static_cast<int>(std::count_if(scores.begin(), scores.end(), holds));
}

std::string Line(const std::string& name, const std::vector<SetupScore>& scores) {
  const auto n = static_cast<int>(scores.size());
  return fmt::format("  {:<32} {:<24} {:<24} {}\n",
                     name,
                     RateText(CountOf(scores, [](const auto& s) { return s.right; }), n),
                     RateText(CountOf(scores, [](const auto& s) { return s.listed; }), n),
                     RateText(CountOf(scores, [](const auto& s) { return s.claimed_wrong; }), n));
}

}  // namespace

SetupScore ScoreSetup(const Json& answer, const Json& result, double right_rms) {
  SetupScore score;
  score.name = answer.value("name", "");
  score.robot = answer.value("robot", "");
  score.kind = answer.value("kind", "");
  for (const Json& mistake : answer["mistakes"]) {
    score.mistakes.push_back(Words(mistake["kind"], mistake["joints"]));
  }
  const Json& setup = result["setup"];
  score.plausible = setup.value("plausible", true);
  std::map<int, std::vector<std::string>> claims;
  std::map<int, double> rms;
  for (const Json& cause : setup["causes"]) {
    const int alternative = cause.value("alternative", 1);
    claims[alternative].push_back(Words(cause["kind"], cause["joints"]));
    rms[alternative] = cause.value("rms_after_m", 0.0);
  }
  score.alternatives = static_cast<int>(claims.size());
  std::vector<std::string> truth = score.mistakes;
  std::sort(truth.begin(), truth.end());
  for (auto& [alternative, claim] : claims) {
    std::vector<std::string> sorted = claim;
    std::sort(sorted.begin(), sorted.end());
    const bool as_good = rms[alternative] > 0 && rms[alternative] <= kFitsAsWell * right_rms &&
                         claim.size() <= truth.size();
    const bool right = sorted == truth || as_good;
    score.listed = score.listed || right;
    if (alternative == 1) {
      score.right = right;
      score.claimed = claim;
    }
  }
  // What base and tool absorb altogether needs no cure.
  if (claims.empty() && score.plausible && FramesMisfit(result) <= kFitsAsWell * right_rms) {
    score.right = score.listed = true;
  }
  score.claimed_wrong = score.alternatives == 1 && !score.right;
  return score;
}

std::vector<SetupScore> RunSetupProof(const ProofOptions& options,
                                      const std::function<void(int done, int all)>& say) {
  ForgetOtherPrograms(options.folder, options.program);
  std::vector<SetupScore> scores(static_cast<std::size_t>(2 * options.setups));
  ForEachCase(2 * options.setups, options.jobs, say, [&](std::size_t k) {
    const int seed = options.first + static_cast<int>(k / 2);
    try {
      scores[k] = k % 2 == 0 ? ProveWrong(options, seed) : ProveRight(options, seed);
    } catch (const std::exception& error) {
      scores[k].name = fmt::format("seed {}", seed);
      scores[k].failure = error.what();
    }
  });
  return scores;
}

std::string SetupTable(const std::vector<SetupScore>& scores) {
  if (scores.empty()) return "";
  std::map<std::string, std::vector<SetupScore>> by;
  std::vector<SetupScore> wrong;
  for (const SetupScore& score : scores) {
    if (!HasMistakes(score) || !score.failure.empty()) continue;
    wrong.push_back(score);
    by["robot " + score.robot].push_back(score);
    by["readings " + score.kind].push_back(score);
    by[fmt::format("mistakes {}", score.mistakes.size())].push_back(score);
    for (const std::string& mistake : score.mistakes) {
      by["with " + mistake.substr(0, mistake.find(' '))].push_back(score);
    }
  }
  std::string text = fmt::format(
      "Files that say something that is not so, 95 % intervals after Wilson\n"
      "  {:<32} {:<24} {:<24} {}\n",
      "",
      "first cause right",
      "right or listed",
      "wrong cause claimed");
  text += Line("all", wrong);
  for (const auto& [name, of_name] : by) text += Line(name, of_name);
  // Beside each wrong case stands its right twin, and each random trial is right.
  const auto judged = static_cast<int>(scores.size());
  text += fmt::format("  right files accused: {}; failures: {}\n",
                      RateText(CountOf(scores, [](const auto& s) { return s.accused; }), judged),
                      CountOf(scores, [](const auto& s) { return !s.failure.empty(); }));
  return text;
}

nlohmann::ordered_json SetupScoreToJson(const SetupScore& score) {
  return {{"name", score.name},
          {"robot", score.robot},
          {"kind", score.kind},
          {"failure", score.failure},
          {"mistakes", score.mistakes},
          {"claimed", score.claimed},
          {"alternatives", score.alternatives},
          {"plausible", score.plausible},
          {"right", score.right},
          {"listed", score.listed},
          {"claimed_wrong", score.claimed_wrong},
          {"accused", score.accused}};
}

}  // namespace dhcal
