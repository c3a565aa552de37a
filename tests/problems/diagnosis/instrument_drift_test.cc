// A scale that drifts is told from links that grow and a base that moves, where the rows can; on
// recordings of the simulator, which shares no code with the library.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

using concealed::Cause;
using concealed::RandomTrial;
using Eigen::Vector3d;

constexpr double kLag = 2500;  // [s]

/// 200 poses of a KR 15 in random order within some hours, read by an instrument that stands
/// `away` from the base.
DiagnosisResult DiagnosisOf(const Vector3d& away, const std::vector<Cause>& causes) {
  RandomTrial trial;
  trial.seed = 31;
  trial.settings.decimals = 6;
  trial.settings.clock = true;
  Rng rng(32);
  trial.drawing = concealed::KukaKr15();
  trial.drawing.base = concealed::Displacement(Vector3d::Zero(), away);
  trial.stated = trial.drawing;
  trial.built = concealed::AsBuilt(trial.drawing, &rng);
  trial.motion = concealed::DrawMotion(trial.settings, trial.drawing, &rng);
  trial.causes = causes;
  const ReadCase read = ReadBack(concealed::FilesOf(trial));
  EXPECT_EQ(read.diagnostics.ToString(), "");
  return Diagnosed(*read.spec, *read.recording);
}

std::vector<std::string> FindingsOf(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) names.push_back(finding.effect.effect);
  return names;
}

std::vector<std::string> AlternativesOf(const DiagnosisResult& d) {
  std::vector<std::string> names;
  for (const Finding& finding : d.findings) {
    for (const Confusable& other : finding.confusable_with) names.push_back(other.effect.effect);
  }
  return names;
}

TEST(InstrumentDriftFound, BesideTheRobotByNameAndSize) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const DiagnosisResult d =
      DiagnosisOf(Vector3d(1, 0.5, -0.5), {concealed::InstrumentGrows(2e-4, kLag)});
  ASSERT_THAT(FindingsOf(d), testing::ElementsAre("instrument_drift")) << d.summary;
  const Finding& finding = d.findings[0];
  EXPECT_EQ(finding.location, "sensor");
  EXPECT_EQ(finding.effect_class, "C5");
  EXPECT_EQ(finding.parameters[0].name, "instrument_drift.scale");
  // The time constant is one of a grid, which the size follows.
  EXPECT_NEAR(finding.parameters[0].value, 2e-4, 4 * finding.parameters[0].sigma + 0.1 * 2e-4);
  EXPECT_LT(finding.rms_test_after, 0.8 * finding.rms_test_before);
}

TEST(InstrumentDriftFound, AGrowingLinkIsNoInstrument) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const DiagnosisResult d =
      DiagnosisOf(Vector3d(1, 0.5, -0.5), {concealed::SecondLinkGrows(4e-4, kLag)});
  EXPECT_THAT(FindingsOf(d), testing::ElementsAre("link_thermal")) << d.summary;
}

TEST(InstrumentDriftFound, ABaseThatMovesAcrossTheLineOfSightIsNoInstrument) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const DiagnosisResult d =
      DiagnosisOf(Vector3d(4, 0, 0), {concealed::BaseDrifts(Vector3d(0, 3e-4, 0), kLag)});
  EXPECT_THAT(FindingsOf(d), testing::ElementsAre("base_drift")) << d.summary;
}

TEST(InstrumentDriftFound, FromAfarAndWeakItIsListedWithABaseThatMoves) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const auto listed = [](const Cause& cause) {
    const DiagnosisResult d = DiagnosisOf(Vector3d(15, 0, 0), {cause});
    std::vector<std::string> names = FindingsOf(d);
    EXPECT_THAT(names, testing::SizeIs(1)) << d.summary;
    for (const std::string& other : AlternativesOf(d)) names.push_back(other);
    return names;
  };
  const auto both =
      testing::AllOf(testing::Contains("instrument_drift"), testing::Contains("base_drift"));
  EXPECT_THAT(listed(concealed::InstrumentGrows(6e-6, kLag)), both);
  EXPECT_THAT(listed(concealed::BaseDrifts(Vector3d(9e-5, 0, 0), kLag)), both);
}

TEST(InstrumentDriftFound, NothingInAColdRecording) {
  const DiagnosisResult d = DiagnosisOf(Vector3d(4, 0, 0), {});
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kConsistent) << d.summary;
}

}  // namespace
}  // namespace dhcal
