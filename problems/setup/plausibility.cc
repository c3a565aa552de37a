#include "problems/setup/plausibility.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/parameter_set.h"
#include "problems/setup/frames_alone.h"
#include "problems/setup/length_units.h"
#include "problems/setup/lint.h"
#include "problems/setup/orientations.h"
#include "problems/setup/own_position.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

// Of the reach, with base and tool fitted: what the nominal robot of the right files misses by at
// most, strong sag included, ...
constexpr double kMisses = 0.01;
// ... what no fit makes good, whatever it corrects, ...
constexpr double kHopeless = 0.04;
// ... and what is worth a question to the doctor, whose answer then decides.
constexpr double kWorthAsking = 0.0015;
// Of the readings' spread: a small volume shows a wrong table by less.
constexpr double kOfSpread = 0.1;
constexpr double kFewDirections = 0.25;     // of the columns: a fit that determines less is none
constexpr double kUsualNoise = 1e-4;        // [m] per coordinate, of a tracker on a poor day
constexpr int kMostWeight = 4 * kOneCause;  // of causes

std::string MissesWords(double misfit) {
  return fmt::format(
      "The nominal robot, with base and tool fitted, {}: as the files stand, what was recorded is "
      "not the robot of the problem file.",
      std::isfinite(misfit) ? "misses the readings by " + InMillimetres(misfit) + " RMS"
                            : "cannot be brought to the readings at all");
}

/// RMS distance of the measured points from their mean [m]; 0 where none are measured.
double SpreadOf(const Recording& recording) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  int count = 0;
  for (Eigen::Index row = 0; row < recording.p_WQ.rows(); ++row) {
    if (!recording.p_WQ.row(row).allFinite()) continue;
    sum += recording.p_WQ.row(row).transpose();
    squares += recording.p_WQ.row(row).squaredNorm();
    ++count;
  }
  if (count == 0) return 0;
  return std::sqrt(std::max(0.0, squares / count - (sum / count).squaredNorm()));
}

bool FarOff(double misfit, const Files& files) {
  const double reach = ReachOf(files.robot());
  if (misfit > kMisses * reach) return true;
  const double spread = SpreadOf(files.recording);
  return spread > 0 && misfit > kWorthAsking * reach && misfit > kOfSpread * spread;
}

/// Poses that the fitted rows are of.
int DistinctPoses(const Recording& recording) {
  const std::vector<int> poses = PosesOfRows(recording);
  std::set<int> distinct;
  for (int row = 0; row < recording.num_rows(); ++row) {
    if (!recording.test(row)) distinct.insert(poses[static_cast<std::size_t>(row)]);
  }
  return static_cast<int>(distinct.size());
}

/// Directions that the readings determine. A noise that was estimated holds all that the model
/// leaves out, and nothing is determined beside strong physics: what counts is then what an
/// instrument of the usual kind would determine.
int Determined(const Result& identified, const FitResult& fit) {
  const bool estimated = std::isnan(fit.chi2_reduced);
  if (!estimated || !(identified.noise_sigma > kUsualNoise)) return fit.rank;
  const double cut = fit.truncation_cut * kUsualNoise / identified.noise_sigma;
  const auto count = std::count_if(fit.singular_values.begin(),
                                   fit.singular_values.end(),
                                   [&](double value) { return value > cut; });
  return std::max(fit.rank, static_cast<int>(count));
}

/// Why the fit itself, whatever the files, is no calibration.
void JudgeFit(const Files& files, const Result& identified, SetupResult* setup) {
  const FitResult* const fit = identified.best();
  if (fit == nullptr) return;
  const int poses = DistinctPoses(files.recording);
  const int numbers = (poses - (identified.kind.pairs ? 1 : 0)) * identified.kind.num_coordinates();
  const bool priors = !files.spec.parameters.prior_sigma.empty();
  if (!priors && numbers < fit->columns) {
    setup->reasons.push_back(fmt::format(
        "The fitted rows are of only {} distinct poses, whose readings are {} numbers for {} "
        "parameters: repeats of a pose tell nothing new. Record at least {} different poses.",
        poses,
        std::max(numbers, 0),
        fit->columns,
        fit->columns / identified.kind.num_coordinates() + (identified.kind.pairs ? 2 : 1)));
  } else if (const int determined = Determined(identified, *fit);
             determined <= kFewDirections * fit->columns) {
    setup->reasons.push_back(fmt::format(
        "The readings determine only {} of {} independent combinations of the parameters. Record "
        "poses in which every joint moves over much of its range, or estimate fewer parameters.",
        determined,
        fit->columns));
  }
}

void Take(Findings findings, SetupJudgement* judgement) {
  if (findings.causes.empty()) return;
  judgement->setup.causes = std::move(findings.causes);
  judgement->cured = std::move(findings.cured);
}

/// Positions and distances: whether the nominal robot can have been recorded.
void JudgeRobot(const Files& files,
                double misfit,
                const Result& identified,
                SetupJudgement* judgement) {
  SetupResult& setup = judgement->setup;
  const MeasurementKind& kind = files.spec.measurement.kind;
  if (!kind.is_point() && !kind.anchors) {
    // The search for causes knows points and distances.
    if (FarOff(misfit, files)) setup.reasons.push_back(MissesWords(misfit));
    return;
  }
  const bool far_off = FarOff(misfit, files);
  if (!far_off && misfit <= kWorthAsking * ReachOf(files.robot())) return;
  const bool several_runs = files.recording.run_names.size() > 1;
  if (several_runs) {
    // Frames that moved between runs are an honest part of a calibration: the diagnosis finds them.
    Findings moved = FindMovedFrames(files, misfit);
    if (!moved.causes.empty() && !FarOff(moved.causes[0].rms_after, files)) {
      Take(std::move(moved), judgement);
      return;
    }
  }
  Take(FindCauses(files, misfit, far_off ? kMostWeight : kOneCause), judgement);
  const bool stands = misfit <= kHopeless * ReachOf(files.robot()) && identified.best() != nullptr;
  if (setup.causes.empty() && (!far_off || stands)) return;
  setup.reasons.push_back(MissesWords(misfit));
  if (!setup.causes.empty()) return;
  setup.reasons.push_back(
      "None of the usual causes alone or together makes it fit (sense, order, zeros and units of "
      "the joints, DH convention, couplings of joints, units and handedness of the readings, rows "
      "that are shifted, frames that moved between runs). Check the table's lengths and twists.");
}

void JudgeOrientation(const Files& files,
                      const FramesAlone& frames_alone,
                      SetupJudgement* judgement) {
  if (!files.spec.measurement.kind.sees_orientation()) return;
  const OrientationFindings findings = FindOrientationForm(files, frames_alone);
  if (!(findings.misfit > kFollowsRobot)) return;
  judgement->setup.reasons.push_back(fmt::format(
      "The measured orientations miss the robot's by {:.0f} mrad RMS, whatever the tool: they are "
      "not the tool's orientations in the frame of the positions.",
      findings.misfit / kMilliradian));
  Take(findings.findings, judgement);
}

/// Base or tool held at values of the file that are far from where they are: a fit that failed for
/// another reason is none of their business.
void JudgeFixedFrames(const Files& files,
                      double misfit,
                      const Result& identified,
                      SetupResult* setup) {
  const auto length = [](double rms, double rms_point) {
    return std::isnan(rms_point) ? rms : rms_point;
  };
  const double as_held = length(identified.nominal.rms, identified.nominal.rms_point);
  if (!FarOff(as_held, files) || FarOff(misfit, files)) return;
  const FitResult* const fit = identified.best();
  if (fit != nullptr && !FarOff(length(fit->rms, fit->rms_point), files)) return;
  std::map<ParameterGroup, int> free;
  for (const Parameter& p : ResolveParameters(files.spec, files.recording).estimated)
    ++free[p.group];
  if (free[ParameterGroup::kBase] > 0 && free[ParameterGroup::kTool] > 0) return;
  SetupCause cause;
  cause.kind = "frame_not_estimated";
  cause.sentence = fmt::format(
      "Base and tool are held at the file's values: with both of them fitted the nominal robot "
      "misses the readings by {} RMS instead of {}.",
      InMillimetres(misfit),
      InMillimetres(as_held));
  cause.where = files.spec.parameters.where;
  cause.text = "estimate: complete";
  cause.rms_before = as_held;
  cause.rms_after = misfit;
  if (fit != nullptr) {
    setup->reasons.push_back(fmt::format("The fit leaves {} RMS, which is no noise.",
                                         InMillimetres(length(fit->rms, fit->rms_point))));
  }
  setup->causes.push_back(std::move(cause));
}

}  // namespace

SetupJudgement JudgeSetup(const ProblemSpec& spec,
                          const Recording& recording,
                          const Result& identified) {
  SetupJudgement judgement;
  const Files files{spec, recording};
  const FramesAlone frames_alone = FitFrames(spec, recording);
  const double misfit = frames_alone.rms;
  JudgeRobot(files, misfit, identified, &judgement);
  if (judgement.setup.reasons.empty()) JudgeOrientation(files, frames_alone, &judgement);
  if (judgement.setup.reasons.empty() && !identified.simulated) {
    if (std::optional<SetupCause> own = OwnPosition(files, misfit)) {
      judgement.setup.reasons.emplace_back("Nothing was measured.");
      judgement.setup.causes = {std::move(*own)};
    }
  }
  if (judgement.setup.reasons.empty()) {
    JudgeFixedFrames(files, misfit, identified, &judgement.setup);
  }
  if (judgement.setup.reasons.empty()) JudgeFit(files, identified, &judgement.setup);
  judgement.setup.plausible = judgement.setup.reasons.empty();
  if (!identified.simulated) judgement.setup.remarks = Lint(spec, recording);
  return judgement;
}

void Refuse(Result* result) {
  for (FitResult& fit : result->fits) {
    fit.usable = false;
    fit.parameters.clear();
    fit.null_space.clear();
  }
  result->best_fit = -1;
  result->comparison.clear();
  result->validation = {};
  result->residuals.clear();
  result->delivered.reset();
  result->diagnosis.reset();
  result->rows_set_aside.clear();
}

}  // namespace dhcal
