#include "problems/diagnosis/diagnose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/findings.h"
#include "problems/diagnosis/held_fit.h"
#include "problems/diagnosis/hypotheses.h"
#include "problems/diagnosis/missing_geometry.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refit.h"
#include "problems/diagnosis/search.h"
#include "problems/diagnosis/verdict.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

// Rows beyond this are thinned for the search (not for the fits).
constexpr std::size_t kMostReadings = 6000;
constexpr std::size_t kLongestPiece = 100;  // of a series, when a long one is thinned
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
  const Eigen::VectorXd y = ProjectOff(space.BasisOf(accepted), clean.y);
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
    clean.nu = static_cast<double>(clean.rows->degrees_of_freedom() - clean.U.cols());
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

/// Readings that follow each other without a gap (differences), cut to pieces of a length; single
/// readings are pieces of their own.
std::vector<std::vector<Reading>> Pieces(const std::vector<Reading>& readings) {
  std::vector<std::vector<Reading>> pieces;
  for (const Reading& reading : readings) {
    const bool follows = reading.previous_idx >= 0 && !pieces.empty() &&
                         pieces.back().back().row_idx == reading.previous_idx &&
                         pieces.back().size() < kLongestPiece;
    if (!follows) pieces.emplace_back();
    pieces.back().push_back(reading);
  }
  return pieces;
}

/// Evenly over the recording. Differences are taken in pieces: one torn out of its series would say
/// little, since its own offset is free.
std::vector<Reading> Thinned(const std::vector<Reading>& readings) {
  if (readings.size() <= kMostReadings) return readings;
  const std::vector<std::vector<Reading>> pieces = Pieces(readings);
  const std::size_t wanted =
      std::max<std::size_t>(1, pieces.size() * kMostReadings / readings.size());
  std::vector<Reading> thinned;
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::vector<Reading>& piece = pieces[k * pieces.size() / wanted];
    thinned.insert(thinned.end(), piece.begin(), piece.end());
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
    if (effect->Describe().is_curve) continue;  // offered by the search
    if (candidates.empty() && effect->Place(context, {}).effect_class != "geometry") {
      const std::string needs = effect->Describe().needs;
      d->not_testable.push_back(
          {effect->Describe().name,
           needs.empty() ? "no joint or instant here that it could be at" : "needs " + needs});
    }
  }
  for (const MapBlock& block : MapBlocks(context)) space->AddMap(block);
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

/// One search with all that it refers to.
struct Pass {
  Pass(const PhysicsContext& context, CleanRows clean_rows)
      : clean(std::move(clean_rows)), space(context, *clean.rows, clean.U, clean.y) {}
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  CleanRows clean;
  HypothesisSpace space;
  SearchOutcome outcome;
};

/// What a search accepted.
std::vector<EffectRequest> NamesOf(const Pass& pass) {
  std::vector<EffectRequest> names;
  for (const int k : pass.outcome.accepted) {
    names.push_back(pass.space.all()[static_cast<std::size_t>(k)].request);
  }
  return names;
}

/// True if what the geometry leaves is more than the stated noise allows.
bool ExceedsNoise(const CleanRows& clean, double false_alarm) {
  return ChiSquareTail(clean.y.squaredNorm(), clean.nu) <= false_alarm;
}

std::string SlowExcess(double rho) {
  return fmt::format(
      "What is left of neighbouring readings correlates ({:.2f}) and exceeds the stated noise: "
      "something changes slowly in time. Serial noise would look the same, so it is given no name.",
      rho);
}

/// All readings to be fitted but those that lie off.
std::vector<Reading> GoodReadings(const Calibration& c, const CleanRows& clean) {
  const std::set<int> off(clean.outliers.begin(), clean.outliers.end());
  std::vector<Reading> good;
  for (const Reading& reading : c.readings.fitted) {
    if (off.count(reading.row_idx) == 0) good.push_back(reading);
  }
  return good;
}

/// Something is there; nothing that was found may be named.
void GiveNoName(SearchOutcome* outcome) {
  outcome->accepted.clear();
  outcome->complete = false;
  outcome->removed_by_names = 0;
  for (TestedSet& set : outcome->tested) set.kept = false;
}

}  // namespace

bool WantsDiagnosis(const ProblemSpec& spec, const Result& identified) {
  if (spec.diagnosis.run == DiagnosisRun::kNever) return false;
  if (spec.diagnosis.run == DiagnosisRun::kAlways) return true;
  // No answer, or one that no manufacture explains, is itself a reason to ask what is wrong.
  if (identified.best() == nullptr) return true;
  if (!RowsPlausible(spec.robot, identified.calibrated)) return true;
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
  // Readings that lie off are sought among all, so that the refit is spared those that the search
  // passes over, too.
  std::vector<Reading> readings = c.readings.fitted;
  std::vector<int> off;
  if (readings.size() > kMostReadings) {
    const CleanRows all = Clean(*before, readings);
    off = all.outliers;
    readings = Thinned(all.readings);
  }
  const auto cleaned = [&] {
    CleanRows rows = Clean(*before, readings);
    rows.outliers.insert(rows.outliers.end(), off.begin(), off.end());
    return rows;
  };
  CleanRows clean = cleaned();
  const bool completed =
      AddMissingGeometry(spec, recording, identified, *before, GoodReadings(c, clean), &d);
  if (c.readings.fitted.size() > kMostReadings) {
    d.notes.push_back(
        fmt::format("{} of {} rows were searched, evenly over the recording; the "
                    "fits use all.",
                    readings.size(),
                    c.readings.fitted.size()));
  }
  const PhysicsContext context = c.Context();
  SearchOptions options;
  options.false_alarm = (completed ? 1 - kShareOfGeometry : 1) * spec.diagnosis.false_alarm;
  options.sigma_known = SourceOfNoise(c).all_given();
  options.nu = clean.nu;
  options.effects = spec.diagnosis.effects;
  options.draws = kDraws;
  auto pass = std::make_unique<Pass>(context, std::move(clean));
  Populate(spec, &pass->space, &d);
  say(fmt::format("{} hypotheses and map cells", pass->space.all().size()));
  pass->outcome = Search(options, &pass->space);
  const double rho = SerialCorrelation(*before, pass->clean, pass->space, pass->outcome.accepted);
  const double significant = std::max(
      kWorthWhitening, kWhitenSigmas / std::sqrt(static_cast<double>(pass->clean.y.size())));
  if (!pass->outcome.consistent && rho > significant && pass->clean.rows->CanWhiten()) {
    say(fmt::format("again with the readings' serial correlation of {:.2f} taken out", rho));
    auto white = std::make_unique<Pass>(context, cleaned());
    Whiten(*before, std::min(rho, kMostCorrelation), &white->clean);
    d.not_testable.clear();
    Populate(spec, &white->space, &d);
    // A correlated noise is not of the size that an independent one would have.
    SearchOptions unknown = options;
    unknown.sigma_known = false;
    unknown.start = NamesOf(*pass);
    white->outcome = Search(unknown, &white->space);
    if (white->outcome.consistent && options.sigma_known &&
        ExceedsNoise(pass->clean, options.false_alarm)) {
      d.notes.push_back(SlowExcess(rho));
      GiveNoName(&pass->outcome);
    } else {
      d.notes.push_back(fmt::format(
          "What is left of neighbouring readings correlates ({:.2f}); it was taken out as serial "
          "noise before the search, so that slow noise is not taken for a drift or a step.",
          rho));
      pass = std::move(white);
    }
  }
  const SearchOutcome& outcome = pass->outcome;
  DescribeMisfit(*before, pass->clean, outcome, &d);

  const std::vector<EffectRequest> names = NamesOf(*pass);
  const bool rest_left =
      !names.empty() &&
      RefitAndJudge(spec, recording, GoodReadings(c, pass->clean), names, say, &d);
  say("what is hidden");
  Conclude(*before, pass->space, outcome, rest_left, &d);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return d;
}

}  // namespace dhcal
