#include "tools/proof/suite.h"

#include <algorithm>
#include <exception>
#include <mutex>

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "tools/proof/case_run.h"
#include "tools/proof/simulator/case_files.h"
#include "tools/proof/simulator/scenarios.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const concealed::Scenario* FindScenario(const std::string& name) {
  for (const concealed::Scenario& scenario : concealed::AllScenarios()) {
    if (scenario.name == name) return &scenario;
  }
  return nullptr;
}

std::string NameOf(const ProofCase& wanted) {
  // The robot goes with the seed; the name is the trial's own, so that both agree.
  constexpr const char* kRobots[] = {"small", "kr15", "ur10"};
  return fmt::format("{}_{}_{:02}", wanted.scenario, kRobots[wanted.seed % 3], wanted.seed);
}

void Make(const ProofCase& wanted, const CasePaths& paths) {
  if (IsMade(paths)) return;
  WriteCase(concealed::FilesOf(concealed::MakeTrial(*FindScenario(wanted.scenario), wanted.seed)),
            paths);
}

/// The fit that is told the truth. Null where there is none.
Json Oracle(const ProofOptions& options, const CasePaths& paths, const Json& answer) {
  const auto text = answer.find("oracle_problem");
  if (text == answer.end()) return nullptr;
  WriteWhole(paths.oracle_problem, text->get<std::string>());
  const fs::path recording = paths.oracle_problem.parent_path() / "recording.csv";
  if (!fs::exists(recording)) fs::create_symlink(fs::absolute(paths.recording), recording);
  if (!RunCase(options.program, paths.oracle_problem, paths.oracle, paths.oracle_log).empty()) {
    return nullptr;
  }
  Json result = ReadJson(paths.oracle / "result.json");
  return result.is_discarded() ? Json(nullptr) : result;
}

ProofScore Failed(const ProofCase& wanted, const std::string& why) {
  ProofScore score;
  score.name = NameOf(wanted);
  score.scenario = wanted.scenario;
  score.seed = wanted.seed;
  score.failure = why;
  return score;
}

ProofScore Prove(const ProofOptions& options, const ProofCase& wanted) {
  const CasePaths paths(options.folder, NameOf(wanted));
  Make(wanted, paths);
  Json result, answer;
  const std::string wrong = RunAndOpen(options.program, paths, &result, &answer);
  if (!wrong.empty()) return Failed(wanted, wrong);
  return ScoreCase(answer, result, Oracle(options, paths, answer));
}

}  // namespace

std::vector<ProofCase> CasesOf(const ProofOptions& options) {
  std::vector<ProofCase> cases;
  if (options.random + options.setups > 0 && options.only.empty() && !options.quick) return cases;
  for (const concealed::Scenario& scenario : concealed::AllScenarios()) {
    const bool wanted = options.only.empty()
                            ? (!options.quick || scenario.quick)
                            : std::find(options.only.begin(), options.only.end(), scenario.name) !=
                                  options.only.end();
    if (!wanted) continue;
    const int seeds = options.quick ? 1 : std::min(options.seeds, scenario.most_seeds);
    for (int seed = 1; seed <= seeds; ++seed) cases.push_back({scenario.name, seed});
  }
  return cases;
}

std::vector<std::string> UnknownScenarios(const ProofOptions& options) {
  std::vector<std::string> unknown;
  for (const std::string& name : options.only) {
    if (FindScenario(name) == nullptr) unknown.push_back(name);
  }
  return unknown;
}

void ForEachCase(int count,
                 int jobs,
                 const std::function<void(int done, int all)>& say,
                 const std::function<void(std::size_t k)>& prove) {
  int done = 0;
  std::mutex mutex;
  const auto work = [&](int k) {
    prove(static_cast<std::size_t>(k));
    const std::lock_guard<std::mutex> lock(mutex);
    say(++done, count);
  };
  ParallelFor(count, work, jobs);
}

std::vector<ProofScore> RunProof(const ProofOptions& options,
                                 const std::function<void(int done, int all)>& say) {
  ForgetOtherPrograms(options.folder, options.program);
  const std::vector<ProofCase> cases = CasesOf(options);
  std::vector<ProofScore> scores(cases.size());
  ForEachCase(static_cast<int>(cases.size()), options.jobs, say, [&](std::size_t k) {
    try {
      scores[k] = Prove(options, cases[k]);
    } catch (const std::exception& error) {
      scores[k] = Failed(cases[k], error.what());
    }
  });
  return scores;
}

}  // namespace dhcal
