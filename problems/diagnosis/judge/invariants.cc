#include "problems/diagnosis/judge/invariants.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/physics/effect.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Sentences = std::vector<std::string>;

constexpr double kMostUnlike = 1e3;

bool IsProbability(double p) { return std::isnan(p) || (p >= 0 && p <= 1); }

void CheckFinding(const Finding& f, const DiagnosisResult& d, Sentences* wrong) {
  const std::string name = InstanceName(f.effect);
  if (!IsProbability(f.p_value)) wrong->push_back(name + ": its p is no probability");
  if (f.p_value > d.false_alarm) {
    wrong->push_back(fmt::format(
        "{}: found although p = {:.3g} exceeds the rate of false alarms", name, f.p_value));
  }
  double surest = 0;
  for (const FoundParameter& p : f.parameters) {
    if (!std::isfinite(p.value) || !(p.sigma >= 0)) {
      wrong->push_back(fmt::format("{}: {} has no number", name, p.name));
    }
    if (p.sigma > 0) surest = std::max(surest, std::abs(p.value) / p.sigma);
    if (p.ci95_low > p.value || p.ci95_high < p.value) {
      wrong->push_back(fmt::format("{}: the interval of {} does not hold its value", name, p.name));
    }
  }
  if (!f.parameters.empty() && surest < kTuning.least_certain) {
    wrong->push_back(name + ": found although no value differs from zero by two sigma");
  }
}

void CheckVerdict(const DiagnosisResult& d, Sentences* wrong) {
  const auto is_physics = [](const Finding& f) { return f.effect_class != "geometry"; };
  const bool physics = std::any_of(d.findings.begin(), d.findings.end(), is_physics);
  const bool alternatives = std::any_of(d.findings.begin(), d.findings.end(), [](const auto& f) {
    return !f.confusable_with.empty();
  });
  const bool by_chance = d.misfit.p_value > d.false_alarm;
  const auto say = [&](const std::string& what) {
    wrong->push_back(fmt::format("{}: {}", ToString(d.verdict), what));
  };
  switch (d.verdict) {
    case DiagnosisVerdict::kConsistent:
      if (!d.findings.empty()) say("but there are findings");
      if (d.unexplained) say("but something is unexplained");
      if (d.misfit.p_value < d.false_alarm) say("but the misfit has a p below the rate");
      break;
    case DiagnosisVerdict::kExplained:
      if (d.findings.empty()) say("but there is no finding");
      if (alternatives) say("but a finding has alternatives");
      if (d.unexplained) say("but something is unexplained");
      break;
    case DiagnosisVerdict::kPartlyExplained:
      if (!physics) say("but no physics is found");
      if (by_chance) say("but the misfit has a p above the rate");
      if (!d.unexplained) say("but nothing is unexplained");
      break;
    case DiagnosisVerdict::kAmbiguous:
      if (!alternatives) say("but no finding has an alternative");
      break;
    case DiagnosisVerdict::kUnexplained:
      if (by_chance) say("but the misfit has a p above the rate");
      if (physics) say("but physics is found");
      break;
    case DiagnosisVerdict::kFailed:
      if (!d.findings.empty()) say("but there are findings");
      break;
  }
}

void CheckRest(const DiagnosisResult& d, Sentences* wrong) {
  if (!d.unexplained) return;
  const Unexplained& rest = *d.unexplained;
  if (!(rest.fraction > 0) || rest.fraction > 1) {
    wrong->push_back(fmt::format("unexplained: a fraction of {:.3g}", rest.fraction));
  }
  if (!(rest.rms >= 0)) wrong->push_back("unexplained: no RMS");
  const double sigma2 = d.misfit.noise_sigma * d.misfit.noise_sigma;
  const double before = d.rms_train_before * d.rms_train_before - sigma2;
  const double after = d.rms_train_after * d.rms_train_after - sigma2;
  // The strongest single part of the rest may be larger than what the two RMS differ by.
  if (before > 0 && after > 0 && rest.fraction < 0.99 * std::min(1.0, after / before)) {
    wrong->push_back(fmt::format("unexplained: a fraction of {:.3g} where the RMS say {:.3g}",
                                 rest.fraction,
                                 after / before));
  }
}

void CheckTotals(const DiagnosisResult& d, Sentences* wrong) {
  if (d.misfit.outliers >= 0 &&
      d.misfit.outliers != static_cast<int>(d.misfit.outlier_rows.size())) {
    wrong->push_back("rows set aside: not as many as are listed");
  }
  if (!IsProbability(d.misfit.p_value)) wrong->push_back("misfit: its p is no probability");
  // Rows of unlike noise, or with rounded angles, make these two differ; not by orders.
  const double in_sigmas = std::sqrt(d.misfit.statistic / d.misfit.dof);
  if (d.misfit.rms > kMostUnlike * in_sigmas * d.misfit.noise_sigma) {
    wrong->push_back(fmt::format("misfit: an RMS of {:.3g} m where the statistic says {:.3g} m",
                                 d.misfit.rms,
                                 in_sigmas * d.misfit.noise_sigma));
  }
  if (!d.findings.empty()) return;
  if (!d.model.empty()) wrong->push_back("a model without findings");
  if (!d.moved.empty()) wrong->push_back("parameters moved by something without findings");
}

}  // namespace

std::vector<std::string> Contradictions(const DiagnosisResult& d) {
  Sentences wrong;
  for (const Finding& finding : d.findings) {
    CheckFinding(finding, d, &wrong);
    for (const std::string& caution : finding.cautions) {
      const bool impossible = caution.find("negative") != std::string::npos ||
                              caution.find("times its usual size") != std::string::npos;
      if (impossible) wrong.push_back(InstanceName(finding.effect) + ": " + caution);
    }
  }
  CheckVerdict(d, &wrong);
  CheckRest(d, &wrong);
  CheckTotals(d, &wrong);
  return wrong;
}

}  // namespace dhcal
