#include "problems/diagnosis/refit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/findings.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

constexpr double kClearGain = 10;     // of BIC, for a freer shape
constexpr double kMaterial = 0.09;    // variance above the noise: less than 0.3 of its deviation
constexpr double kAboveNoise = 1e-3;  // probability of the rest by noise alone

class Refit {
 public:
  Refit(const ProblemSpec& spec, const Recording& recording, const std::vector<Reading>& fitted)
      : spec_(spec), recording_(recording), fitted_(fitted) {}

  /// `near`: of other effects, to start from; may be null.
  std::unique_ptr<CompleteFit> With(const std::vector<EffectRequest>& names,
                                    const CompleteFit* near) const {
    return FitComplete(spec_, recording_, names, &fitted_, {}, near);
  }

  /// Frees the shapes that the readings ask to be freed; each is asked once.
  std::unique_ptr<CompleteFit> Freed(std::unique_ptr<CompleteFit> fit,
                                     std::vector<EffectRequest>* shapes) {
    for (std::size_t i = 0; i < shapes->size(); ++i) {
      const EffectRequest& shape = (*shapes)[i];
      const std::optional<EffectRequest> freer =
          FindEffect(shape.effect)->WithFreeShape(fit->calibration.Context(), shape);
      const bool known = SourceOfNoise(fit->calibration).all_given();
      if (!freer || (known && !IsAboveNoise(*fit))) continue;
      if (!asked_.insert(InstanceName(shape)).second) continue;
      std::vector<EffectRequest> tried = *shapes;
      tried[i] = *freer;
      auto fit_freer = With(tried, fit.get());
      if (!fit_freer->usable()) continue;
      const Noise& noise = fit->fit.noise_seen;
      const DesignRows rows = RowsOf(*fit, noise);
      const auto n = static_cast<double>(rows.degrees_of_freedom());
      const auto more = static_cast<double>(fit_freer->calibration.parameters.size() -
                                            fit->calibration.parameters.size());
      const double gain =
          n * std::log(rows.y().squaredNorm() / RowsOf(*fit_freer, noise).y().squaredNorm());
      if (gain < more * std::log(n) + kClearGain) continue;
      *shapes = tried;
      fit = std::move(fit_freer);
    }
    return fit;
  }

  /// True if a fit stays above the noise by what matters.
  bool IsAboveNoise(const CompleteFit& fit) const {
    const Calibration& c = fit.calibration;
    if (!SourceOfNoise(c).all_given()) return false;
    const DesignRows rows = RowsOf(fit, fit.fit.noise_seen);
    const double squares = rows.y().squaredNorm();
    const auto count = static_cast<double>(rows.degrees_of_freedom());
    const double dof = count - static_cast<double>(c.parameters.size());
    return dof > 0 && squares > (1 + kMaterial) * count &&
           ChiSquareTail(squares, dof) < kAboveNoise;
  }

 private:
  /// What a fit leaves of the fitted rows, in units of a noise.
  DesignRows RowsOf(const CompleteFit& fit, const Noise& noise) const {
    return DesignRows(fit.calibration, fit.state(), noise, fitted_);
  }

  const ProblemSpec& spec_;
  const Recording& recording_;
  const std::vector<Reading>& fitted_;
  std::set<std::string> asked_;  // effects whose shapes were tried free
};

/// Findings of freed shapes go by the name of the effect itself.
void NameFreed(const std::vector<EffectRequest>& shapes,
               const std::vector<EffectRequest>& names,
               std::vector<Finding>* findings) {
  for (Finding& finding : *findings) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (shapes[i].SameAs(names[i]) || !finding.effect.SameAs(shapes[i])) continue;
      finding.effect = names[i];
      finding.cautions.emplace_back(
          "the masses of the problem file do not bring the fit down to the noise, so its moments "
          "were fitted, too: the masses are not as stated, a spring or counterweight helps the "
          "joint, or something else is left out");
    }
  }
}

/// What would be missed most comes first. Not by their p-values, which underflow for all that is
/// strong.
void SortBySize(std::vector<Finding>* findings) {
  std::stable_sort(findings->begin(), findings->end(), [](const Finding& a, const Finding& b) {
    if (a.rms_train_before != b.rms_train_before) return a.rms_train_before > b.rms_train_before;
    return InstanceName(a.effect) < InstanceName(b.effect);
  });
}

/// Positions of the finding that helps the prediction least.
std::vector<std::size_t> LeastHelpful(const std::vector<Finding>& findings,
                                      const std::vector<EffectRequest>& names) {
  const auto worst = std::min_element(findings.begin(), findings.end(), [](auto& a, auto& b) {
    return a.delta_log_predictive < b.delta_log_predictive;
  });
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (OneFinding(worst->effect, names[i])) positions.push_back(i);
  }
  return positions;
}

/// Notes each finding that goes with the names at some positions.
void NoteWithdrawal(const std::vector<std::size_t>& gone,
                    const std::vector<EffectRequest>& names,
                    DiagnosisResult* d) {
  std::vector<EffectRequest> noted;
  for (const std::size_t i : gone) {
    const bool is_noted = std::any_of(noted.begin(), noted.end(), [&](const EffectRequest& other) {
      return OneFinding(other, names[i]);
    });
    if (is_noted) continue;
    noted.push_back(names[i]);
    d->notes.push_back(fmt::format(
        "{} fits the rows but does not help to predict rows left out; it was withdrawn.",
        InstanceName(names[i])));
  }
}

std::vector<EffectRequest> WithoutThose(const std::vector<std::size_t>& gone,
                                        const std::vector<EffectRequest>& effects) {
  std::vector<EffectRequest> left;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (std::find(gone.begin(), gone.end(), i) == gone.end()) left.push_back(effects[i]);
  }
  return left;
}

/// Of the model that holds: a withdrawn one's are nobody's.
void TakeTotals(const Totals& totals, DiagnosisResult* d) {
  d->validation_method = totals.validation_method;
  d->rms_train_before = totals.rms_train_before;
  d->rms_train_after = totals.rms_train_after;
  d->rms_test_before = totals.rms_test_before;
  d->rms_test_after = totals.rms_test_after;
}

}  // namespace

Refitted RefitAndJudge(const ProblemSpec& spec,
                       const Recording& recording,
                       const std::vector<Reading>& fitted,
                       std::vector<EffectRequest> names,
                       const std::function<void(const std::string&)>& say,
                       DiagnosisResult* d) {
  Refit refit(spec, recording, fitted);
  const auto before = refit.With({}, nullptr);
  if (!before->usable()) return {nullptr, true};
  bool withdrawn = false;
  std::vector<EffectRequest> shapes = names;  // the names as they are fitted
  while (!names.empty()) {
    say(fmt::format("refit with {} effects", names.size()));
    auto after = refit.With(shapes, before.get());
    if (!after->usable()) {
      d->notes.push_back("The fit with the named effects failed: " + after->fit.summary.message);
      return {nullptr, true};
    }
    std::vector<std::size_t> gone = Unhelpful(shapes, *after);
    if (gone.empty()) {
      after = refit.Freed(std::move(after), &shapes);
      gone = Unhelpful(shapes, *after);
    }
    if (gone.empty()) {
      auto [findings, totals] = DescribeFindings(shapes, *before, *after);
      NameFreed(shapes, names, &findings);
      const bool hold = after->calibration.readings.test.empty()
                            ? totals.rms_test_after < totals.rms_test_before
                            : !TestRowsSpeakAgainst(*before, *after);
      if (hold) {
        SortBySize(&findings);
        std::move(findings.begin(), findings.end(), std::back_inserter(d->findings));
        TakeTotals(totals, d);
        d->model = WithValues(shapes, *after);
        const std::vector<MovedParameter> moved = MovedParameters(*before, *after);
        d->moved.insert(d->moved.end(), moved.begin(), moved.end());
        const bool rest_left = withdrawn || refit.IsAboveNoise(*after);
        return {std::move(after), rest_left};
      }
      gone = LeastHelpful(findings, names);
    }
    withdrawn = true;
    NoteWithdrawal(gone, names, d);
    names = WithoutThose(gone, names);
    shapes = WithoutThose(gone, shapes);
  }
  return {nullptr, withdrawn};
}

}  // namespace dhcal
