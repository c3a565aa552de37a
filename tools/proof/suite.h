// The concealed suite as a folder: makes its cases, runs the program on them, opens the seals.
//
//   cases/<name>/problem.yaml, recording.csv    what the program gets
//   sealed/<name>.json                          the answer; its hash is in problem.yaml
//   results/<name>/                             what the program wrote
//   oracle/<name>/                              the same fit, told the truth
//   logs/<name>.txt                             what the program printed
//
// What is there already is kept, so that a run that was stopped goes on; a program that changed
// since is run anew.
#ifndef DHCAL_TOOLS_PROOF_SUITE_H_
#define DHCAL_TOOLS_PROOF_SUITE_H_

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/proof/score.h"

namespace dhcal {

struct ProofOptions {
  std::filesystem::path folder;
  std::filesystem::path program;  // ceres_dhcal
  std::vector<std::string> only;  // scenarios; empty = all
  int seeds = 20;
  bool quick = false;  // one seed of the quick scenarios
  int jobs = 1;
  int random = 0;  // random trials; > 0 = these alone, unless scenarios are named
  int setups = 0;  // wrong set-ups, beside as many right ones; alone, as `random`
  int first = 1;   // seed of the first
};

struct ProofCase {
  std::string scenario;
  int seed = 1;
};

/// The cases of a suite. An unknown scenario in `only` is not among them.
std::vector<ProofCase> CasesOf(const ProofOptions& options);

/// Names of scenarios that do not exist.
std::vector<std::string> UnknownScenarios(const ProofOptions& options);

/// Runs `prove` for each of `count` cases, `jobs` at a time; `say` gets the number of those done.
void ForEachCase(int count,
                 int jobs,
                 const std::function<void(int done, int all)>& say,
                 const std::function<void(std::size_t k)>& prove);

/// Makes, runs and scores the cases of scenarios; `say` gets the number of those done. A case that
/// cannot be scored says why in `failure`.
std::vector<ProofScore> RunProof(const ProofOptions& options,
                                 const std::function<void(int done, int all)>& say);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_SUITE_H_
