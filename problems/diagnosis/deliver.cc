#include "problems/diagnosis/deliver.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/joint_errors.h"
#include "problems/fit_analysis.h"
#include "problems/judgement.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"
#include "problems/start.h"
#include "problems/task/task_error.h"
#include "problems/validation.h"

namespace dhcal {
namespace {

// The diagnosis' fit has priors and this one truncates: what the two leave differs by less.
constexpr double kMissed = 1.1;

/// A fit that owns what it refers to.
class OwnFit {
 public:
  /// `d` (may be null): whose joint fit it starts from.
  OwnFit(const ProblemSpec& user,
         const ProblemSpec& problem,
         const Recording& recording,
         const DiagnosisResult* d,
         const Progress& progress)
      : spec(problem), calibration(spec, recording) {
    FitSettings settings;
    const bool same_frames = problem.robot.base_per_run == user.robot.base_per_run &&
                             problem.robot.tool_per_run == user.robot.tool_per_run;
    if (d != nullptr && same_frames) {
      calibration.frames = AlignedFrames(user, recording);
      calibration.UpdateEffects();
      settings = SettingsOf(calibration, progress);
      settings.start = StartAt(*d);
      if (!SourceOfNoise(calibration).sigma_given) settings.noise.sigma = d->misfit.noise_sigma;
    } else {
      AlignStart(&calibration);
      FitFramesAlone(&calibration, progress);
      settings = SettingsOf(calibration, progress);
    }
    fit = RunBentFit(settings, &calibration);
  }
  OwnFit(const OwnFit&) = delete;
  OwnFit& operator=(const OwnFit&) = delete;

  bool usable() const { return fit.summary.IsSolutionUsable(); }
  RobotModel Robot() const { return CalibratedRobot(calibration, fit.summary.state); }

  ProblemSpec spec;
  Calibration calibration;
  Fit fit;

 private:
  /// The diagnosis' joint fit as a state of this calibration.
  Eigen::VectorXd StartAt(const DiagnosisResult& d) const {
    Eigen::VectorXd start =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(calibration.parameters.size()));
    for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
      const Parameter& p = calibration.parameters[k];
      const bool of_effect = p.effect_column >= 0;
      const auto& values = of_effect ? calibration.EffectOf(p.effect_column).values : d.geometry;
      const auto known = values.find(of_effect ? calibration.ColumnOf(p).parameter : p.name);
      if (known != values.end()) start[static_cast<Eigen::Index>(k)] = known->second;
    }
    return start;
  }
};

/// The problem with the geometry that was found missing, its columns of any unit kept by the noise.
ProblemSpec WithGeometryFound(const ProblemSpec& user,
                              const Recording& recording,
                              const DiagnosisResult& d) {
  const Calibration file(user, recording);
  const CompleteFit whole(user, recording);
  ProblemSpec spec = user;
  for (const Completion& completion : MissingCompletions(file, whole.calibration)) {
    const bool found = std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) {
      return completion.request.SameAs(f.effect);
    });
    if (found) spec = WithCompletion(spec, completion);
  }
  spec.solver.rule = TruncationRule::kNoise;
  return spec;
}

/// True for a frame that differs between runs, where the file estimates it: then every run has one
/// of its own in the robot from here on, and no effect is needed.
bool IsFrameOfRuns(const EffectRequest& effect, ProblemSpec* spec) {
  const auto estimates = [&](const char* group) {
    const std::vector<std::string>& names = spec->parameters.estimate;
    const auto any_of = {std::string(group), std::string("complete")};
    return std::find_first_of(names.begin(), names.end(), any_of.begin(), any_of.end()) !=
           names.end();
  };
  if (effect.effect == "base_per_run" && estimates("base")) {
    spec->robot.base_per_run = true;
    return true;
  }
  if (effect.effect == "tool_per_run" && estimates("tool") && spec->robot.targets.empty()) {
    spec->robot.tool_per_run = true;
    return true;
  }
  return false;
}

std::vector<EffectRequest> HeldAt(const Calibration& c, const Eigen::VectorXd& state) {
  std::vector<EffectRequest> held = c.effects;
  for (EffectRequest& effect : held) {
    if (!effect.held) effect.values.clear();
    effect.held = true;
  }
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const Parameter& p = c.parameters[k];
    if (p.effect_column < 0) continue;
    const std::size_t of = c.effect_of_column[static_cast<std::size_t>(p.effect_column)];
    held[of].values[c.ColumnOf(p).parameter] = state[static_cast<Eigen::Index>(k)];
  }
  return held;
}

/// True if any effect beside the first `given` is the robot's own, and not that of its instrument.
bool MovesTheRobot(const std::vector<EffectRequest>& effects, std::size_t given) {
  return std::any_of(
      effects.begin() + static_cast<std::ptrdiff_t>(given), effects.end(), [](const auto& effect) {
        return !FindEffect(effect.effect)->Describe().of_instrument;
      });
}

void AddNoteOnMasses(const ProblemSpec& user, Result* result) {
  result->notes.push_back(
      user.robot.links.empty()
          ? "The masses of the links are not given; the delivered model has usual ones, fitted to "
            "the readings. They are no measurement of a mass."
          : "The delivered model has masses of the links that the fit moved within their usual "
            "uncertainty (robot.links of calibrated.yaml); the compliances under PARAMETERS are "
            "for "
            "these masses, those under UNMODELLED EFFECTS for the masses as stated.");
}

/// The third prediction of every row, and what it leaves.
void AddPredictions(const OwnFit& own, const FitAnalysis& analysis, Result* result) {
  std::vector<RowResidual> rows = DescribeRows(own.calibration, analysis, *own.fit.problem);
  auto row = rows.begin();
  for (RowResidual& of_rigid : result->residuals) {
    while (row != rows.end() && row->row_idx < of_rigid.row_idx) ++row;
    if (row == rows.end() || row->row_idx != of_rigid.row_idx) continue;
    of_rigid.predicted_effects = std::move(row->predicted_after);
    of_rigid.residual = std::move(row->residual);
    of_rigid.standardised = std::move(row->standardised);
    of_rigid.length = row->length;
    of_rigid.sigmas = row->sigmas;
    of_rigid.leverage = row->leverage;
  }
}

}  // namespace

void Deliver(const ProblemSpec& user,
             const Recording& recording,
             const Progress& progress,
             Result* result) {
  const DiagnosisResult& d = *result->diagnosis;
  if (d.findings.empty() || result->best() == nullptr) return;
  if (progress) progress({"geometry and effects found, fitted together", kShareAtDelivery});
  const ProblemSpec rigid = WithGeometryFound(user, recording, d);
  ProblemSpec spec = rigid;
  for (const EffectRequest& effect : d.model) {
    if (!IsFrameOfRuns(effect, &spec)) spec.parameters.effects.push_back(effect);
  }
  if (!d.links.empty()) spec.robot.links = d.links;
  const OwnFit own(user, spec, recording, &d, progress);
  const std::optional<FitAnalysis> analysis =
      own.usable() ? Analyse(own.calibration, own.fit) : std::nullopt;
  if (!analysis) {
    result->notes.push_back(
        "The solver found no usable fit of geometry and effects together; calibrated.yaml holds "
        "the rigid robot.");
    return;
  }
  if (!d.links.empty()) AddNoteOnMasses(user, result);
  DeliveredModel model;
  const Eigen::VectorXd& state = own.fit.summary.state;
  model.fit = DescribeFit(own.calibration, own.fit, &*analysis);
  model.robot = own.Robot();
  model.effects = HeldAt(own.calibration, state);
  model.validation = Validate(own.calibration, *analysis, *own.fit.problem);
  model.intervals = JudgeDelivered(d);
  if (MovesTheRobot(own.spec.parameters.effects, user.parameters.effects.size())) {
    const bool as_file_asks = rigid.parameters.estimate == user.parameters.estimate;
    model.rigid = as_file_asks ? result->calibrated
                               : OwnFit(user, rigid, recording, nullptr, progress).Robot();
  }
  if (!d.averaged && model.fit.rms > kMissed * d.rms_train_after) {
    result->notes.push_back(fmt::format(
        "The delivered model leaves {:.3g} mm RMS per coordinate, the diagnosis' own fit {:.3g} "
        "mm: parts without a name and priors are in that only.",
        model.fit.rms / kMillimetre,
        d.rms_train_after / kMillimetre));
  }
  AddPredictions(own, *analysis, result);
  if (result->task) {
    FillTaskError(own.calibration, analysis->identifiability, state, &*result->task);
  }
  model.joint_errors = JointErrorsOf(own.calibration, state, result->residuals);
  result->delivered = std::move(model);
}

}  // namespace dhcal
