// A sound result passes; each way of contradicting itself is noticed.
#include "problems/diagnosis/judge/invariants.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

using testing::Contains;
using testing::HasSubstr;

DiagnosisResult Sound() {
  DiagnosisResult d;
  d.verdict = DiagnosisVerdict::kPartlyExplained;
  d.false_alarm = 0.01;
  d.misfit.p_value = 1e-20;
  d.misfit.noise_sigma = 20e-6;
  d.misfit.statistic = 25 * 400;
  d.misfit.dof = 400;
  d.misfit.rms = 100e-6;
  d.misfit.outliers = 2;
  d.misfit.outlier_rows = {7, 40};
  d.rms_train_before = 100e-6;
  d.rms_train_after = 40e-6;
  Finding finding;
  finding.effect.effect = "joint_compliance";
  finding.effect.joint = 2;
  finding.effect_class = "C1";
  finding.p_value = 1e-9;
  finding.parameters.push_back(
      {"joint_compliance.2.compliance", 3e-6, 1e-7, 2.8e-6, 3.2e-6, "rad/(N m)"});
  d.findings.push_back(finding);
  d.model.push_back(finding.effect);
  Unexplained rest;
  rest.fraction = (40. * 40 - 20 * 20) / (100. * 100 - 20 * 20);
  rest.rms = 34.6e-6;
  d.unexplained = rest;
  return d;
}

TEST(Contradictions, ASoundResultHasNone) { EXPECT_TRUE(Contradictions(Sound()).empty()); }

TEST(Contradictions, EachIsNoticed) {
  using Change = std::function<void(DiagnosisResult*)>;
  const std::vector<std::pair<std::string, Change>> changes = {
      {"exceeds the rate", [](DiagnosisResult* d) { d->findings[0].p_value = 0.18; }},
      {"two sigma", [](DiagnosisResult* d) { d->findings[0].parameters[0].sigma = 2e-6; }},
      {"interval", [](DiagnosisResult* d) { d->findings[0].parameters[0].ci95_low = 4e-6; }},
      {"no number", [](DiagnosisResult* d) { d->findings[0].parameters[0].value = kUnknown; }},
      {"negative",
       [](DiagnosisResult* d) { d->findings[0].cautions = {"compliance is negative"}; }},
      {"usual size",
       [](DiagnosisResult* d) { d->findings[0].cautions = {"7000 times its usual size"}; }},
      {"there are findings",
       [](DiagnosisResult* d) { d->verdict = DiagnosisVerdict::kConsistent; }},
      {"something is unexplained",
       [](DiagnosisResult* d) { d->verdict = DiagnosisVerdict::kExplained; }},
      {"physics is found", [](DiagnosisResult* d) { d->verdict = DiagnosisVerdict::kUnexplained; }},
      {"no finding has an alternative",
       [](DiagnosisResult* d) { d->verdict = DiagnosisVerdict::kAmbiguous; }},
      {"nothing is unexplained", [](DiagnosisResult* d) { d->unexplained.reset(); }},
      {"a fraction of 0", [](DiagnosisResult* d) { d->unexplained->fraction = 0; }},
      {"where the RMS say", [](DiagnosisResult* d) { d->unexplained->fraction = 0.01; }},
      {"not as many", [](DiagnosisResult* d) { d->misfit.outlier_rows.pop_back(); }},
      {"an RMS of", [](DiagnosisResult* d) { d->misfit.rms = 5; }},
      {"no physics is found", [](DiagnosisResult* d) { d->findings.clear(); }},
      {"a model without findings", [](DiagnosisResult* d) { d->findings.clear(); }},
      {"no probability", [](DiagnosisResult* d) { d->findings[0].p_value = -1; }},
  };
  for (const auto& [words, change] : changes) {
    DiagnosisResult d = Sound();
    change(&d);
    EXPECT_THAT(Contradictions(d), Contains(HasSubstr(words))) << words;
  }
}

}  // namespace
}  // namespace dhcal
