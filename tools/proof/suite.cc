#include "tools/proof/suite.h"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "tools/proof/run_program.h"
#include "tools/proof/simulator/case_files.h"
#include "tools/proof/simulator/scenarios.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char kAnswerHash[] = "sha256 of the sealed answer: ";

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

Json ReadJson(const fs::path& file) {
  return Json::parse(ReadAll(file), nullptr, /*allow_exceptions=*/false);
}

struct CasePaths {
  CasePaths(const fs::path& folder, const std::string& name)
      : problem(folder / "cases" / name / "problem.yaml"),
        recording(folder / "cases" / name / "recording.csv"),
        answer(folder / "sealed" / (name + ".json")),
        result(folder / "results" / name),
        oracle_problem(folder / "oracle" / name / "problem.yaml"),
        oracle(folder / "oracle" / name / "result"),
        log(folder / "logs" / (name + ".txt")),
        oracle_log(folder / "logs" / (name + "_oracle.txt")) {}

  fs::path problem, recording, answer, result, oracle_problem, oracle, log, oracle_log;
};

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
  if (fs::exists(paths.problem) && fs::exists(paths.recording) && fs::exists(paths.answer)) return;
  const concealed::CaseFiles files =
      concealed::FilesOf(concealed::MakeTrial(*FindScenario(wanted.scenario), wanted.seed));
  WriteWhole(paths.answer, files.answer);
  WriteWhole(paths.recording, files.recording);
  WriteWhole(paths.problem, files.problem);
}

/// "" or why the program gave no result.
std::string Run(const fs::path& program,
                const fs::path& problem,
                const fs::path& out,
                const fs::path& log) {
  if (fs::exists(out / "result.json")) return "";
  fs::create_directories(log.parent_path());
  fs::create_directories(out.parent_path());
  const int status =
      RunProgram(program, {"--problem", problem.string(), "--out", out.string(), "--quiet"}, log);
  if (status == 0) return "";
  return fmt::format(
      "{} ended with status {}; see {}", program.filename().string(), status, log.string());
}

/// Opens the seal: only now, after the program has answered.
std::string Open(const CasePaths& paths, Json* answer) {
  const std::string text = ReadAll(paths.answer);
  const std::string problem = ReadAll(paths.problem);
  if (problem.find(kAnswerHash + concealed::Sha256(text)) == std::string::npos) {
    return fmt::format("{} is not the answer that {} names by its hash",
                       paths.answer.string(),
                       paths.problem.string());
  }
  *answer = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return answer->is_discarded() ? paths.answer.string() + " is no JSON" : "";
}

/// The fit that is told the truth. Null where there is none.
Json Oracle(const ProofOptions& options, const CasePaths& paths, const Json& answer) {
  const auto text = answer.find("oracle_problem");
  if (text == answer.end()) return nullptr;
  WriteWhole(paths.oracle_problem, text->get<std::string>());
  const fs::path recording = paths.oracle_problem.parent_path() / "recording.csv";
  if (!fs::exists(recording)) fs::create_symlink(fs::absolute(paths.recording), recording);
  if (!Run(options.program, paths.oracle_problem, paths.oracle, paths.oracle_log).empty()) {
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
  std::string wrong = Run(options.program, paths.problem, paths.result, paths.log);
  if (!wrong.empty()) return Failed(wanted, wrong);
  Json answer;
  wrong = Open(paths, &answer);
  if (!wrong.empty()) return Failed(wanted, wrong);
  const Json result = ReadJson(paths.result / "result.json");
  if (result.is_discarded()) return Failed(wanted, "result.json is no JSON");
  return ScoreCase(answer, result, Oracle(options, paths, answer));
}

/// Results of another build of the program are not its own.
void ForgetOtherPrograms(const ProofOptions& options) {
  const fs::path mark = options.folder / "program.sha256";
  const std::string now = concealed::Sha256(ReadAll(options.program)) + "\n";
  if (fs::exists(mark) && ReadAll(mark) == now) return;
  for (const char* const part : {"results", "oracle", "logs"}) {
    fs::remove_all(options.folder / part);
  }
  WriteWhole(mark, now);
}

}  // namespace

void WriteWhole(const fs::path& file, const std::string& text) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  const fs::path aside = file.string() + ".part";
  {
    std::ofstream stream(aside, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error("cannot write " + aside.string());
  }
  fs::rename(aside, file);
}

std::vector<ProofCase> CasesOf(const ProofOptions& options) {
  std::vector<ProofCase> cases;
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

std::vector<ProofScore> RunProof(const ProofOptions& options,
                                 const std::function<void(int done, int all)>& say) {
  ForgetOtherPrograms(options);
  const std::vector<ProofCase> cases = CasesOf(options);
  std::vector<ProofScore> scores(cases.size());
  const auto count = static_cast<int>(cases.size());
  int done = 0;
  std::mutex mutex;
  const auto work = [&](int idx) {
    const auto k = static_cast<std::size_t>(idx);
    try {
      scores[k] = Prove(options, cases[k]);
    } catch (const std::exception& error) {
      scores[k] = Failed(cases[k], error.what());
    }
    const std::lock_guard<std::mutex> lock(mutex);
    say(++done, count);
  };
  ParallelFor(count, work, options.jobs);
  return scores;
}

}  // namespace dhcal
