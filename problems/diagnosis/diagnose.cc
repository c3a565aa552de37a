#include "problems/diagnosis/diagnose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
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
#include "problems/diagnosis/clean_rows.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/held_fit.h"
#include "problems/diagnosis/hypotheses.h"
#include "problems/diagnosis/missing_geometry.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refit.h"
#include "problems/diagnosis/search.h"
#include "problems/diagnosis/set_tester.h"
#include "problems/diagnosis/verdict.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

// Rows beyond this are thinned for the search (not for the fits).
constexpr std::size_t kMostReadings = 6000;
constexpr std::size_t kLongestPiece = 100;  // of a series, when a long one is thinned
constexpr int kDraws = 2000;
constexpr double kWorthWhitening = 0.1;  // smallest serial correlation that is taken out
constexpr double kWhitenSigmas = 4;
constexpr double kMostCorrelation = 0.95;

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

bool IsWanted(const std::vector<std::string>& effects, const std::string& effect) {
  return effects.empty() || std::find(effects.begin(), effects.end(), effect) != effects.end();
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
        // What may not be named must not accuse either.
        space->AddEffect(request, IsWanted(spec.diagnosis.effects, request.effect));
      } else if (reported.emplace(request.effect, reason).second) {
        d->not_testable.push_back({InstanceName(request), reason});
      }
    }
    if (effect->Describe().is_curve) continue;  // offered by the search
    if (candidates.empty() && !effect->Describe().completes) {
      const std::string needs = effect->Describe().needs;
      d->not_testable.push_back(
          {effect->name(),
           needs.empty() ? "no joint or instant here that it could be at" : "needs " + needs});
    }
  }
  for (const MapBlock& block : MapBlocks(context)) space->AddMap(block);
}

void DescribeMisfit(const CompleteFit& fit,
                    const CleanRows& clean,
                    const SearchOutcome& outcome,
                    DiagnosisResult* d) {
  const std::vector<int>& row = clean.rows->now_row();
  Misfit& misfit = d->misfit;
  misfit.noise_known = SourceOfNoise(fit.calibration).all_given();
  misfit.noise_sigma = RmsAsRead(fit.calibration,
                                 fit.fit.noise_seen,
                                 row,
                                 Eigen::VectorXd::Ones(static_cast<Eigen::Index>(row.size())));
  misfit.rows = static_cast<int>(clean.readings.size());
  misfit.statistic = clean.y.squaredNorm();
  misfit.dof = clean.nu;
  misfit.p_value = outcome.p_geometry;
  misfit.p_floor = Combine(1.0 / (kDraws + 1), 1);
  misfit.rms = clean.rms;
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

/// Something is there; nothing that was found may be named.
void GiveNoName(SearchOutcome* outcome) {
  outcome->accepted.clear();
  outcome->complete = false;
  outcome->removed_by_names = 0;
  for (TestedSet& set : outcome->tested) set.kept = false;
}

/// The steps of one diagnosis. Rows that lie off are judged twice: by the geometry before there is
/// anything else, and again by the geometry with what was found, since strong physics makes rows
/// lie off that do not, and hides others that do.
class Diagnoser {
 public:
  Diagnoser(const ProblemSpec& spec, const Recording& recording, const Progress& progress)
      : spec_(spec), recording_(recording), progress_(progress) {}

  DiagnosisResult Run(const Result& identified) {
    Say("complete geometry");
    geometry_ = FitComplete(spec_, recording_, {}, nullptr, progress_);
    if (!geometry_->usable()) {
      DiagnosisResult d;
      d.false_alarm = spec_.diagnosis.false_alarm;
      d.verdict = DiagnosisVerdict::kUnexplained;
      d.summary = "the complete geometry could not be fitted, so nothing can be said: " +
                  geometry_->fit.summary.message;
      return d;
    }
    const Calibration& c = geometry_->calibration;
    context_ = std::make_unique<PhysicsContext>(c.Context());
    const Calibration own(spec_, recording_);
    share_of_search_ = MissingCompletions(own, c).empty() ? 1 : 1 - kShareOfGeometry;
    std::set<int> off = RowsThatLieOff(*geometry_, c.readings.fitted);
    Attempt attempt = Try(off);
    if (attempt.refitted.fit) {
      const std::set<int> off_now = RowsThatLieOff(*attempt.refitted.fit, c.readings.fitted);
      if (off_now != off) {
        Say("again with the rows that lie off from what was found");
        off = off_now;
        attempt = Try(off);
      }
    }
    return Finish(identified, off, std::move(attempt));
  }

 private:
  struct Attempt {
    DiagnosisResult d;
    std::vector<Reading> readings;  // all that do not lie off
    std::unique_ptr<Pass> pass;
    Refitted refitted;
  };

  void Say(const std::string& text) const {
    if (progress_) progress_("diagnosis: " + text);
  }

  /// Search and refit without some rows.
  Attempt Try(const std::set<int>& off) const {
    const Calibration& c = geometry_->calibration;
    Attempt attempt;
    attempt.readings = WithoutRows(c, c.readings.fitted, off);
    DiagnosisResult& d = attempt.d;
    d.false_alarm = spec_.diagnosis.false_alarm;
    const std::vector<Reading> searched = Thinned(attempt.readings);
    if (searched.size() < attempt.readings.size()) {
      d.notes.push_back(
          fmt::format("{} of {} rows were searched, evenly over the recording; the fits use all.",
                      searched.size(),
                      attempt.readings.size()));
    }
    attempt.pass = SearchPass(searched, &d);
    DescribeMisfit(*geometry_, attempt.pass->clean, attempt.pass->outcome, &d);
    const std::vector<EffectRequest> names = NamesOf(*attempt.pass);
    if (!names.empty()) {
      attempt.refitted = RefitAndJudge(
          spec_, recording_, attempt.readings, names, [&](const auto& text) { Say(text); }, &d);
    }
    return attempt;
  }

  /// Searches, once more with the rows' serial correlation taken out where there is one.
  std::unique_ptr<Pass> SearchPass(const std::vector<Reading>& readings, DiagnosisResult* d) const {
    auto pass = std::make_unique<Pass>(*context_, TakeOutModel(*geometry_, readings));
    SearchOptions options;
    options.false_alarm = share_of_search_ * spec_.diagnosis.false_alarm;
    options.sigma_known = SourceOfNoise(geometry_->calibration).all_given();
    options.nu = pass->clean.nu;
    options.effects = spec_.diagnosis.effects;
    options.draws = kDraws;
    Populate(spec_, &pass->space, d);
    Say(fmt::format("{} hypotheses and map cells", pass->space.all().size()));
    pass->outcome = Search(options, &pass->space);
    const double rho =
        SerialCorrelation(*geometry_, pass->clean, pass->space, pass->outcome.accepted);
    const double significant = std::max(
        kWorthWhitening, kWhitenSigmas / std::sqrt(static_cast<double>(pass->clean.y.size())));
    if (pass->outcome.consistent || rho <= significant || !pass->clean.rows->CanWhiten()) {
      return pass;
    }
    Say(fmt::format("again with the readings' serial correlation of {:.2f} taken out", rho));
    auto white = std::make_unique<Pass>(*context_, TakeOutModel(*geometry_, readings));
    WhitenSerially(*geometry_, std::min(rho, kMostCorrelation), &white->clean);
    d->not_testable.clear();
    Populate(spec_, &white->space, d);
    // A correlated noise is not of the size that an independent one would have.
    SearchOptions unknown = options;
    unknown.sigma_known = false;
    unknown.start = NamesOf(*pass);
    white->outcome = Search(unknown, &white->space);
    if (white->outcome.consistent && options.sigma_known &&
        ExceedsNoise(pass->clean, options.false_alarm)) {
      d->notes.push_back(SlowExcess(rho));
      GiveNoName(&pass->outcome);
      return pass;
    }
    d->notes.push_back(fmt::format(
        "What is left of neighbouring readings correlates ({:.2f}); it was taken out as serial "
        "noise before the search, so that slow noise is not taken for a drift or a step.",
        rho));
    return white;
  }

  DiagnosisResult Finish(const Result& identified,
                         const std::set<int>& off,
                         Attempt attempt) const {
    DiagnosisResult& d = attempt.d;
    const CompleteFit& joint = attempt.refitted.fit ? *attempt.refitted.fit : *geometry_;
    const std::set<int> misread = MisreadTestRows(*geometry_, joint);
    std::set<int> aside = off;
    aside.insert(misread.begin(), misread.end());
    d.misfit.outliers = static_cast<int>(aside.size());
    d.misfit.outlier_rows.assign(aside.begin(), aside.end());
    Say("missing geometry");
    const Calibration& c = geometry_->calibration;
    const Readings readings{attempt.readings, WithoutRows(c, c.readings.test, misread)};
    AddMissingGeometry(spec_, recording_, identified, joint, readings, &d);
    Say("what is hidden");
    const Pass& pass = *attempt.pass;
    Conclude(*geometry_, pass.space, pass.outcome, attempt.refitted.rest_left, &d);
    return d;
  }

  const ProblemSpec& spec_;
  const Recording& recording_;
  const Progress& progress_;
  std::unique_ptr<CompleteFit> geometry_;    // complete, without physics
  std::unique_ptr<PhysicsContext> context_;  // at it
  double share_of_search_ = 1;               // of the false-alarm rate
};

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

DiagnosisResult Guarded(const std::function<DiagnosisResult()>& diagnose) {
  std::string fault = "an unknown error";
  try {
    return diagnose();
  } catch (const std::exception& error) {
    fault = error.what();
  } catch (...) {
  }
  DiagnosisResult d;
  d.verdict = DiagnosisVerdict::kFailed;
  d.summary = fmt::format(
      "the diagnosis broke down ({}), so nothing is known of left-out physics. The calibration was "
      "made before and does not depend on it",
      fault);
  return d;
}

DiagnosisResult Diagnose(const ProblemSpec& spec,
                         const Recording& recording,
                         const Result& identified,
                         const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  DiagnosisResult d = Diagnoser(spec, recording, progress).Run(identified);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return d;
}

}  // namespace dhcal
