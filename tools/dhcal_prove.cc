// Proves the diagnosis on recordings whose answer the program is not told.
//
//   dhcal_prove --out DIR [--quick] [--seeds N] [--only D4,D5] [--jobs N]
//   dhcal_prove --out DIR --random N [--first SEED] [--only D4,D5] [--jobs N]
//   dhcal_prove --out DIR --setups N [--first SEED] [--jobs N]
//   dhcal_prove --list
//
// Makes recordings of arms with left-out physics (tools/proof/simulator, which shares nothing with
// the identification), runs ceres_dhcal on each as a user would, opens the sealed answers and
// prints what was found, what was missed and where it abstained. DIR/proof.json holds all outcomes.
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gflags/gflags.h>

#include "core/base/parallel.h"
#include "tools/proof/case_run.h"
#include "tools/proof/random_rates.h"
#include "tools/proof/random_suite.h"
#include "tools/proof/random_table.h"
#include "tools/proof/run_program.h"
#include "tools/proof/setup_suite.h"
#include "tools/proof/simulator/scenarios.h"
#include "tools/proof/suite.h"
#include "tools/proof/table.h"

DEFINE_string(out, "proof", "folder for cases, answers, results and proof.json");
DEFINE_string(program, "", "the program to prove, default: ceres_dhcal beside this one");
DEFINE_string(only, "", "scenarios, such as D4,D5; default all");
DEFINE_int32(seeds, 20, "trials of each scenario");
DEFINE_int32(random,
             0,
             "random trials, of robots, files, readings and causes drawn by seed; alone, unless "
             "--only or --quick name scenarios, too");
DEFINE_int32(setups,
             0,
             "recordings whose files say something that is not so, beside random trials whose "
             "files are right; alone, as --random");
DEFINE_int32(first, 1, "seed of the first random trial or set-up");
DEFINE_int32(jobs, 0, "cases at a time, default: one per processor");
DEFINE_bool(quick, false, "one trial of the most telling scenarios");
DEFINE_bool(list, false, "print the scenarios");
DEFINE_bool(verbose, false, "print a line per case");

namespace dhcal {
namespace {

std::vector<std::string> Split(const std::string& list) {
  std::vector<std::string> items;
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    if (!item.empty()) items.push_back(item);
  }
  return items;
}

void PrintCases(const std::vector<ProofScore>& scores) {
  for (const ProofScore& s : scores) {
    std::string findings;
    for (const std::string& finding : s.findings) findings += "  " + finding;
    std::cout << fmt::format("{:<16} {:<17}{}{}{}{}\n",
                             s.name,
                             s.failure.empty() ? s.verdict : s.failure,
                             s.false_alarm ? " FALSE ALARM" : "",
                             s.wrong_single ? " WRONG NAME" : "",
                             s.detectable && s.library_has_all && !s.named ? " not named" : "",
                             findings);
  }
}

void PrintRandom(const std::vector<RandomScore>& scores) {
  for (const RandomScore& s : scores) {
    std::string line =
        fmt::format("{:<9} {:<17}", s.name, s.failure.empty() ? s.verdict : s.failure);
    if (s.false_alarm) line += " FALSE ALARM";
    if (s.wrong_single) line += " WRONG NAME";
    if (s.judged && !s.listed) line += " MISSED";
    if (s.extra) line += " EXTRA";
    if (s.geometry_extra) line += " GEOMETRY";
    if (!s.contradictions.empty()) line += " CONTRADICTS ITSELF";
    for (const CauseScore& cause : s.causes) {
      line += fmt::format("  {}{}.{} {:.2g}",
                          cause.detectable ? "" : "~",
                          cause.effect.empty() ? "outside" : cause.effect,
                          cause.joint,
                          cause.visible);
    }
    for (const std::string& geometry : s.geometry) line += "  " + geometry;
    line += "  ->";
    for (const std::string& finding : s.findings) line += "  " + finding;
    std::cout << line << "\n";
  }
}

void PrintSetups(const std::vector<SetupScore>& scores) {
  for (const SetupScore& s : scores) {
    std::cout << fmt::format("{:<9} {:<8} {:<9} {}{}{}{}  {} -> {} ({})\n",
                             s.name,
                             s.robot,
                             s.kind,
                             s.failure,
                             s.accused ? " ACCUSED" : "",
                             s.claimed_wrong ? " WRONG" : "",
                             !s.mistakes.empty() && !s.right ? " NOT RIGHT" : "",
                             fmt::join(s.mistakes, ", "),
                             fmt::join(s.claimed, ", "),
                             s.alternatives);
  }
}

void WriteJson(const std::filesystem::path& file,
               const std::vector<ProofScore>& scores,
               const std::vector<RandomScore>& random,
               const std::vector<SetupScore>& setups,
               double seconds) {
  nlohmann::ordered_json proof = {{"program_version", DHCAL_VERSION},
                                  {"seconds", seconds},
                                  {"figures", FiguresToJson(Figures(scores))},
                                  {"cases", nlohmann::ordered_json::array()}};
  for (const ProofScore& score : scores) proof["cases"].push_back(ScoreToJson(score));
  if (!random.empty()) {
    proof["random_rates"] = RandomRatesToJson(RandomRates(random));
    for (const RandomScore& score : random) proof["random"].push_back(RandomScoreToJson(score));
  }
  for (const SetupScore& score : setups) proof["setups"].push_back(SetupScoreToJson(score));
  WriteWhole(file, proof.dump(1) + "\n");
}

int Run() {
  ProofOptions options;
  options.folder = std::filesystem::absolute(FLAGS_out);
  options.program = FLAGS_program.empty() ? OwnProgram().parent_path() / "ceres_dhcal"
                                          : std::filesystem::absolute(FLAGS_program);
  options.only = Split(FLAGS_only);
  options.seeds = FLAGS_seeds;
  options.quick = FLAGS_quick;
  options.random = FLAGS_random;
  options.setups = FLAGS_setups;
  options.first = FLAGS_first;
  options.jobs = FLAGS_jobs > 0 ? FLAGS_jobs : NumProcessors();
  if (!std::filesystem::exists(options.program)) {
    std::cerr << fmt::format(
        "dhcal_prove: {} does not exist; build it, or name it with --program\n",
        options.program.string());
    return 2;
  }
  for (const std::string& name : UnknownScenarios(options)) {
    std::cerr << fmt::format("dhcal_prove: --only names {}, which is no scenario; see --list\n",
                             name);
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto say = [&](int done, int all) {
    if (terminal) std::cerr << fmt::format("\r{} of {} cases, {:.0f} s ", done, all, seconds());
  };
  const std::vector<ProofScore> scores = RunProof(options, say);
  const std::vector<RandomScore> random = RunRandomProof(options, say);
  const std::vector<SetupScore> setups = RunSetupProof(options, say);
  if (terminal) std::cerr << "\n";
  if (FLAGS_verbose) PrintCases(scores);
  if (FLAGS_verbose) PrintRandom(random);
  if (FLAGS_verbose) PrintSetups(setups);
  if (!scores.empty()) std::cout << ProofTable(scores);
  std::cout << RandomTable(random) << SetupTable(setups)
            << fmt::format("{} cases in {:.0f} s; all outcomes: {}\n",
                           scores.size() + random.size() + setups.size(),
                           seconds(),
                           (options.folder / "proof.json").string());
  WriteJson(options.folder / "proof.json", scores, random, setups, seconds());
  const auto failed = [](const auto& score) { return !score.failure.empty(); };
  return std::any_of(scores.begin(), scores.end(), failed) ||
                 std::any_of(random.begin(), random.end(), failed) ||
                 std::any_of(setups.begin(), setups.end(), failed)
             ? 1
             : 0;
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  try {
    gflags::SetUsageMessage(
        "proves the diagnosis on recordings whose answer it is not told\n\n"
        "  dhcal_prove --out DIR [--quick] [--seeds N] [--only D4,D5] [--jobs N] [--verbose]\n"
        "  dhcal_prove --out DIR --random N [--first SEED] [--only D4,D5] [--jobs N] [--verbose]\n"
        "  dhcal_prove --out DIR --setups N [--first SEED] [--jobs N] [--verbose]\n"
        "  dhcal_prove --list");
    gflags::ParseCommandLineFlags(&argc, &argv, true);
    if (argc > 1) {
      std::cerr << "dhcal_prove: unknown argument " << argv[1] << "; see --help\n";
      return 2;
    }
    if (!FLAGS_list) return dhcal::Run();
    for (const auto& scenario : dhcal::concealed::AllScenarios()) {
      std::cout << fmt::format("{:<5} {}\n", scenario.name, scenario.story);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "dhcal_prove: " << error.what() << "\n";
    return 2;
  }
}
