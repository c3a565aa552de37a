#include "problems/diagnosis/diagnose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/findings.h"
#include "problems/diagnosis/hypotheses.h"
#include "problems/diagnosis/missing_geometry.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/search.h"
#include "problems/diagnosis/verdict.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

// Rows beyond this are thinned for the search (not for the fits).
constexpr std::size_t kMostReadings = 6000;
constexpr int kOutlierRounds = 3;
constexpr int kDraws = 2000;
constexpr double kWorthWhitening = 0.1;  // smallest serial correlation that is taken out
constexpr double kWhitenSigmas = 4;
constexpr double kMostCorrelation = 0.95;

/// The rows of a fit without the readings that lie off, and the geometry taken out.
struct CleanRows {
  std::vector<Reading> readings;  // used
  std::vector<int> outliers;      // rows of the recording
  std::unique_ptr<DesignRows> rows;
  Eigen::MatrixXd U;
  Eigen::VectorXd y;
  double nu = 0;
};

/// Takes a lag-1 correlation out of rows that are clean already.
void Whiten(const CompleteFit& fit, double rho, CleanRows* clean) {
  clean->rows->WhitenSerially(rho);
  clean->U = ModelBasis(fit, clean->readings, rho);
  clean->y = ProjectOff(clean->U, clean->rows->y());
}

/// Lag-1 correlation, within runs, of what the accepted hypotheses leave.
double SerialCorrelation(const CompleteFit& fit,
                         const CleanRows& clean,
                         const HypothesisSpace& space,
                         const std::vector<int>& accepted) {
  Eigen::VectorXd y = clean.y;
  for (const int k : accepted) {
    y = ProjectOff(OrthonormalBasis(space.Projected(k), 1e-6), y);
  }
  const Recording& recording = fit.calibration.recording;
  const int coordinates = clean.rows->coordinates();
  double product = 0, square = 0;
  for (Eigen::Index k = coordinates; k < y.size(); ++k) {
    const int row = clean.rows->now_row()[static_cast<std::size_t>(k)];
    const int before = clean.rows->now_row()[static_cast<std::size_t>(k - coordinates)];
    if (recording.run(row) != recording.run(before)) continue;
    product += y[k] * y[k - coordinates];
    square += y[k] * y[k];
  }
  return square > 0 ? product / square : 0;
}

CleanRows Clean(const CompleteFit& fit, std::vector<Reading> readings) {
  CleanRows clean;
  const Calibration& c = fit.calibration;
  for (int round = 0; round <= kOutlierRounds; ++round) {
    clean.readings = readings;
    clean.rows = std::make_unique<DesignRows>(c, fit.state(), fit.fit.noise_seen, readings);
    clean.U = ModelBasis(fit, readings);
    clean.y = ProjectOff(clean.U, clean.rows->y());
    clean.nu = static_cast<double>(clean.rows->num_rows() - clean.U.cols());
    const bool plain = clean.rows->num_readings() == static_cast<int>(readings.size());
    if (round == kOutlierRounds || !plain) break;
    const std::vector<bool> flagged = FlagOutliers(clean.y, clean.U, clean.rows->coordinates());
    if (FollowAJoint(*clean.rows, clean.y, flagged, c.recording.num_joints())) break;
    std::vector<Reading> good;
    for (std::size_t k = 0; k < readings.size(); ++k) {
      if (flagged[k]) {
        clean.outliers.push_back(readings[k].row_idx);
      } else {
        good.push_back(readings[k]);
      }
    }
    if (good.size() == readings.size()) break;
    readings = good;
  }
  return clean;
}

std::vector<Reading> Thinned(const std::vector<Reading>& readings) {
  if (readings.size() <= kMostReadings) return readings;
  std::vector<Reading> thinned;
  for (std::size_t k = 0; k < kMostReadings; ++k) {
    thinned.push_back(readings[k * readings.size() / kMostReadings]);
  }
  return thinned;
}

/// Fills the space with the library and the map; lists what cannot be tested.
void Populate(const ProblemSpec& spec, HypothesisSpace* space, DiagnosisResult* d) {
  const PhysicsContext& context = space->context();
  std::set<std::pair<std::string, std::string>> reported;
  for (const Effect* const effect : AllEffects()) {
    const std::vector<EffectRequest> candidates = effect->Candidates(context);
    for (const EffectRequest& request : candidates) {
      const auto& active = spec.parameters.effects;
      if (std::any_of(active.begin(), active.end(), [&](const EffectRequest& e) {
            return e.SameAs(request);
          })) {
        continue;
      }
      const std::string reason = effect->NotTestable(context, request);
      if (reason.empty()) {
        space->AddEffect(request);
      } else if (reported.emplace(request.effect, reason).second) {
        d->not_testable.push_back({InstanceName(request), reason});
      }
    }
    if (effect->Describe().name == "transmission_error") continue;  // offered by the search
    if (candidates.empty() && effect->Place(context, {}).effect_class != "geometry") {
      d->not_testable.push_back({effect->Describe().name, "needs " + effect->Describe().needs});
    }
  }
  for (const MapBlock& block : MapBlocks(context)) space->AddMap(block);
}

/// True if a finding stands for a request: its own, or another line of its joint's gear.
bool StandsFor(const Finding& finding, const EffectRequest& request) {
  if (finding.effect.SameAs(request)) return true;
  return request.effect == "gear_harmonic" && finding.effect.effect == request.effect &&
         finding.effect.joint == request.joint;
}

/// Fits the names together with the geometry and takes back those that rows not fitted speak
/// against, until all that are left predict them. True if any was taken back.
bool RefitAndJudge(const ProblemSpec& spec,
                   const Recording& recording,
                   const Calibration& c,
                   const CleanRows& clean,
                   std::vector<EffectRequest> names,
                   const Progress& say,
                   DiagnosisResult* d) {
  std::vector<Reading> fitted;
  const std::set<int> off(clean.outliers.begin(), clean.outliers.end());
  for (const Reading& reading : c.readings.fitted) {
    if (off.count(reading.row_idx) == 0) fitted.push_back(reading);
  }
  const auto before = FitComplete(spec, recording, {}, &fitted, {});
  if (!before->usable()) return true;
  bool withdrawn = false;
  while (!names.empty()) {
    say(fmt::format("refit with {} effects", names.size()));
    const auto after = FitComplete(spec, recording, names, &fitted, {});
    if (!after->usable()) {
      d->notes.push_back("The fit with the named effects failed: " + after->fit.summary.message);
      return true;
    }
    std::vector<Finding> findings = DescribeFindings(names, *before, *after, d);
    // The one that hurts the prediction most goes first: the others may then predict better.
    const auto worst = std::min_element(findings.begin(), findings.end(), [](auto& a, auto& b) {
      return a.delta_log_predictive < b.delta_log_predictive;
    });
    if (worst->delta_log_predictive >= 0 && d->rms_test_after < d->rms_test_before) {
      std::move(findings.begin(), findings.end(), std::back_inserter(d->findings));
      d->model = WithValues(names, *after);
      d->moved = MovedParameters(*before, *after);
      return withdrawn;
    }
    withdrawn = true;
    d->notes.push_back(fmt::format(
        "{} fits the rows but does not help to predict rows left out; it was withdrawn.",
        InstanceName(worst->effect)));
    const Finding gone = *worst;
    names.erase(
        std::remove_if(
            names.begin(), names.end(), [&](const EffectRequest& e) { return StandsFor(gone, e); }),
        names.end());
  }
  return withdrawn;
}

void DescribeMisfit(const CompleteFit& fit,
                    const CleanRows& clean,
                    const SearchOutcome& outcome,
                    DiagnosisResult* d) {
  Misfit& misfit = d->misfit;
  misfit.noise_known = SourceOfNoise(fit.calibration).all_given();
  misfit.noise_sigma = fit.fit.noise_seen.sigma;
  misfit.rows = static_cast<int>(clean.readings.size());
  misfit.outliers = static_cast<int>(clean.outliers.size());
  misfit.statistic = clean.y.squaredNorm();
  misfit.dof = clean.nu;
  misfit.p_value = outcome.p_geometry;
  misfit.rms =
      misfit.noise_sigma * std::sqrt(clean.y.squaredNorm() / static_cast<double>(clean.y.size()));
}

}  // namespace

bool WantsDiagnosis(const ProblemSpec& spec, const Result& identified) {
  if (spec.diagnosis.run == DiagnosisRun::kNever || identified.best() == nullptr) return false;
  if (spec.diagnosis.run == DiagnosisRun::kAlways) return true;
  const bool noise_free = spec.simulate && spec.simulate->noise <= kFinestSigma;
  return !noise_free && identified.best()->rms > kFinestSigma;
}

DiagnosisResult Diagnose(const ProblemSpec& spec,
                         const Recording& recording,
                         const Result& identified,
                         const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto say = [&](const std::string& text) {
    if (progress) progress("diagnosis: " + text);
  };
  DiagnosisResult d;
  d.false_alarm = spec.diagnosis.false_alarm;
  say("complete geometry");
  const auto before = FitComplete(spec, recording, {}, nullptr, progress);
  if (!before->usable()) {
    d.verdict = DiagnosisVerdict::kUnexplained;
    d.summary = "the complete geometry could not be fitted, so nothing can be said: " +
                before->fit.summary.message;
    return d;
  }
  const Calibration& c = before->calibration;
  AddMissingGeometry(spec, recording, identified, *before, &d);

  CleanRows clean = Clean(*before, Thinned(c.readings.fitted));
  if (c.readings.fitted.size() > kMostReadings) {
    d.notes.push_back(
        fmt::format("{} of {} rows were searched, evenly over the recording; the "
                    "fits use all.",
                    kMostReadings,
                    c.readings.fitted.size()));
  }
  const PhysicsContext context = c.Context();
  SearchOptions options;
  options.false_alarm = spec.diagnosis.false_alarm;
  options.sigma_known = SourceOfNoise(c).all_given();
  options.nu = clean.nu;
  options.effects = spec.diagnosis.effects;
  options.draws = kDraws;
  auto space = std::make_unique<HypothesisSpace>(context, *clean.rows, clean.U, clean.y);
  Populate(spec, space.get(), &d);
  say(fmt::format("{} hypotheses and map cells", space->all().size()));
  SearchOutcome outcome = Search(options, space.get());
  const double rho = SerialCorrelation(*before, clean, *space, outcome.accepted);
  const double significant =
      std::max(kWorthWhitening, kWhitenSigmas / std::sqrt(static_cast<double>(clean.y.size())));
  if (!outcome.consistent && rho > significant && clean.rows->CanWhiten()) {
    say(fmt::format("again with the readings' serial correlation of {:.2f} taken out", rho));
    d.notes.push_back(fmt::format(
        "What is left of neighbouring readings correlates ({:.2f}); it was taken out as serial "
        "noise before the search, so that slow noise is not taken for a drift or a step.",
        rho));
    Whiten(*before, std::min(rho, kMostCorrelation), &clean);
    d.not_testable.clear();
    space = std::make_unique<HypothesisSpace>(context, *clean.rows, clean.U, clean.y);
    Populate(spec, space.get(), &d);
    // A correlated noise is not of the size that an independent one would have.
    options.sigma_known = false;
    outcome = Search(options, space.get());
  }
  DescribeMisfit(*before, clean, outcome, &d);

  std::vector<EffectRequest> names;
  for (const int k : outcome.accepted) {
    names.push_back(space->all()[static_cast<std::size_t>(k)].request);
  }
  const bool withdrawn = !names.empty() && RefitAndJudge(spec, recording, c, clean, names, say, &d);
  say("what is hidden");
  Conclude(*before, *space, outcome, withdrawn, &d);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return d;
}

}  // namespace dhcal
