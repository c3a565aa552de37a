// Noise of which a part wanders is no drift, no step and no rest; what the clock does to the robot
// is found beside it. On recordings of the simulator, which shares no code with the library.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/physics/effect.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"
#include "tests/tools/proof/simulator/read_back.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/random/random_files.h"
#include "tools/proof/simulator/screw.h"

namespace dhcal {
namespace {

using concealed::RandomTrial;

/// 200 poses of a KR 15 in random order within some hours.
RandomTrial TrialOf(std::uint64_t seed, double wandering, double wandering_on) {
  RandomTrial trial;
  trial.seed = seed;
  trial.settings.decimals = 6;
  trial.settings.wandering = wandering;
  trial.settings.wandering_on = wandering_on;
  Rng rng(seed + 1000);
  trial.drawing = concealed::KukaKr15();
  trial.stated = trial.drawing;
  trial.built = concealed::AsBuilt(trial.drawing, &rng);
  trial.motion = concealed::DrawMotion(trial.settings, trial.drawing, &rng);
  return trial;
}

DiagnosisResult DiagnosisOf(const RandomTrial& trial) {
  const ReadCase read = ReadBack(concealed::FilesOf(trial));
  EXPECT_EQ(read.diagnostics.ToString(), "");
  return Diagnosed(*read.spec, *read.recording);
}

TEST(SlowNoise, IsNothingLeftOut) {
  const std::uint64_t seeds = kSanitized ? 1 : 6;
  int accused = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const double wandering_on : {0.8, 0.95}) {
      const DiagnosisResult d = DiagnosisOf(TrialOf(seed, 0.35, wandering_on));
      if (d.verdict == DiagnosisVerdict::kConsistent) continue;
      ++accused;
      std::string names;
      for (const Finding& finding : d.findings) names += " " + InstanceName(finding.effect);
      RecordProperty("accused_" + std::to_string(accused),
                     std::to_string(seed) + ": " + d.summary + names);
    }
  }
  EXPECT_LE(accused, 1) << "of " << 2 * seeds;
}

TEST(SlowNoise, LeavesADriftItsName) {
  const std::uint64_t seeds = kSanitized ? 1 : 3;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    RandomTrial trial = TrialOf(seed, 0.2, 0.9);
    trial.causes = {concealed::SecondLinkGrows(6e-4, 2500)};
    const DiagnosisResult d = DiagnosisOf(trial);
    ASSERT_FALSE(d.findings.empty()) << d.summary;
    EXPECT_EQ(d.findings[0].effect.effect, "link_thermal") << d.summary;
  }
}

}  // namespace
}  // namespace dhcal
