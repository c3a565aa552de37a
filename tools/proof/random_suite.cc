#include "tools/proof/random_suite.h"

#include <cstddef>
#include <exception>
#include <string>

#include "tools/proof/case_run.h"
#include "tools/proof/simulator/random/random_files.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal {
namespace {

RandomScore FailedRandom(int seed, const std::string& why) {
  RandomScore score;
  score.name = concealed::NameOfRandom(seed);
  score.seed = seed;
  score.failure = why;
  return score;
}

RandomScore ProveRandom(const ProofOptions& options, int seed) {
  const CasePaths paths(options.folder, concealed::NameOfRandom(seed));
  if (!IsMade(paths)) WriteCase(concealed::FilesOf(concealed::MakeRandomTrial(seed)), paths);
  nlohmann::json result, answer;
  const std::string wrong = RunAndOpen(options.program, paths, &result, &answer);
  if (!wrong.empty()) return FailedRandom(seed, wrong);
  return ScoreRandomCase(answer, result);
}

}  // namespace

std::vector<RandomScore> RunRandomProof(const ProofOptions& options,
                                        const std::function<void(int done, int all)>& say) {
  ForgetOtherPrograms(options.folder, options.program);
  std::vector<RandomScore> scores(static_cast<std::size_t>(options.random));
  ForEachCase(options.random, options.jobs, say, [&](std::size_t k) {
    const int seed = options.first + static_cast<int>(k);
    try {
      scores[k] = ProveRandom(options, seed);
    } catch (const std::exception& error) {
      scores[k] = FailedRandom(seed, error.what());
    }
  });
  return scores;
}

}  // namespace dhcal
