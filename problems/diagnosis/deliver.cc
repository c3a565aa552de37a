#include "problems/diagnosis/deliver.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/completions.h"
#include "problems/fit_analysis.h"
#include "problems/judgement.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"
#include "problems/start.h"
#include "problems/validation.h"

namespace dhcal {
namespace {

// The diagnosis' fit has priors and this one truncates: what the two leave differs by less.
constexpr double kReached = 1.02;
constexpr double kMissed = 1.1;

/// A fit that owns what it refers to.
struct OwnFit {
  OwnFit(const ProblemSpec& problem, const Recording& recording, const Progress& progress)
      : spec(problem), calibration(spec, recording) {
    AlignStart(&calibration);
    FitFramesAlone(&calibration, progress);
    fit = RunBentFit(SolverMethod::kSvdGaussNewton,
                     OptionsOf(spec.solver),
                     InitialNoise(calibration),
                     progress,
                     &calibration);
  }
  OwnFit(const OwnFit&) = delete;
  OwnFit& operator=(const OwnFit&) = delete;

  bool usable() const { return fit.summary.IsSolutionUsable(); }
  RobotModel Robot() const { return CalibratedRobot(calibration, fit.summary.state); }
  double Rms() const {
    return usable() ? Statistics(calibration, fit.summary.state, calibration.readings.fitted).rms
                    : kNotSet;
  }

  ProblemSpec spec;
  Calibration calibration;
  Fit fit;
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

std::vector<EffectRequest> HeldAt(const std::vector<EffectRequest>& effects,
                                  const Calibration& c,
                                  const Eigen::VectorXd& state) {
  std::vector<EffectRequest> held = effects;
  auto next = std::find_if(c.parameters.begin(), c.parameters.end(), [](const Parameter& p) {
    return p.effect_column >= 0;
  });
  const PhysicsContext context = c.Context();
  for (EffectRequest& effect : held) {
    if (effect.held) continue;
    effect.held = true;
    effect.values.clear();
    for (const EffectColumn& column : EffectColumns(context, effect)) {
      effect.values[column.parameter] = state[next - c.parameters.begin()];
      ++next;
    }
  }
  return held;
}

/// With the masses as stated; where the announced error cannot be reached so, with those that the
/// diagnosis fitted.
std::unique_ptr<OwnFit> FitFound(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Progress& progress,
                                 Result* result) {
  const DiagnosisResult& d = *result->diagnosis;
  std::unique_ptr<OwnFit> as_stated;
  if (d.links.empty() || !spec.robot.links.empty()) {
    as_stated = std::make_unique<OwnFit>(spec, recording, progress);
    if (d.links.empty() || as_stated->Rms() <= kReached * d.rms_train_after) return as_stated;
  }
  ProblemSpec with_masses = spec;
  with_masses.robot.links = d.links;
  auto adjusted = std::make_unique<OwnFit>(with_masses, recording, progress);
  if (as_stated != nullptr && !(adjusted->Rms() < as_stated->Rms())) return as_stated;
  result->notes.push_back(
      as_stated == nullptr
          ? "The masses of the links are not given; the delivered model has usual ones, fitted to "
            "the readings. They are no measurement of a mass."
          : "The delivered model has masses of the links that the fit moved within their usual "
            "uncertainty (robot.links of calibrated.yaml); the compliances under PARAMETERS are "
            "for "
            "these masses, those under LEFT-OUT PHYSICS for the masses as stated.");
  return adjusted;
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
  const ProblemSpec rigid = WithGeometryFound(user, recording, d);
  ProblemSpec spec = rigid;
  spec.parameters.effects.insert(spec.parameters.effects.end(), d.model.begin(), d.model.end());
  const std::unique_ptr<OwnFit> own = FitFound(spec, recording, progress, result);
  const std::optional<FitAnalysis> analysis =
      own->usable() ? Analyse(own->calibration, own->fit) : std::nullopt;
  if (!analysis) {
    result->notes.push_back(
        "The solver found no usable fit of geometry and effects together; calibrated.yaml holds "
        "the rigid robot.");
    return;
  }
  DeliveredModel model;
  const Eigen::VectorXd& state = own->fit.summary.state;
  model.fit = DescribeFit(own->calibration, own->fit, &*analysis);
  model.robot = own->Robot();
  model.effects = HeldAt(own->spec.parameters.effects, own->calibration, state);
  model.validation = Validate(own->calibration, *analysis, *own->fit.problem);
  model.intervals = JudgeDelivered(d);
  if (!d.model.empty()) {
    const bool as_file_asks = rigid.parameters.estimate == user.parameters.estimate;
    model.rigid = as_file_asks ? result->calibrated : OwnFit(rigid, recording, progress).Robot();
  }
  if (model.fit.rms > kMissed * d.rms_train_after) {
    result->notes.push_back(fmt::format(
        "The delivered model leaves {:.3g} mm RMS per coordinate, the diagnosis' own fit {:.3g} "
        "mm: parts without a name and priors are in that only.",
        model.fit.rms / kMillimetre,
        d.rms_train_after / kMillimetre));
  }
  AddPredictions(*own, *analysis, result);
  result->delivered = std::move(model);
}

}  // namespace dhcal
