#include "problems/diagnosis/missing_geometry.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/assembly.h"
#include "problems/diagnosis/clean_rows.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/concealed_frame.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/projection.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"

namespace dhcal {
namespace {

struct Gain {
  double p = 1;
  double removed = 0;
  Eigen::MatrixXd basis;
};

Gain GainOf(const Eigen::MatrixXd& U,
            const Eigen::MatrixXd& columns,
            const Eigen::VectorXd& y,
            double dof,
            bool sigma_known) {
  Gain gain;
  // What the file's own parameters can do is not missing.
  gain.basis = OrthonormalBasis(ProjectOff(U, columns));
  const Eigen::VectorXd norms = columns.colwise().norm();
  if (gain.basis.cols() == 0 || norms.maxCoeff() <= 0) return gain;
  if (ProjectOff(U, columns).norm() < 1e-6 * columns.norm()) {
    gain.basis.resize(columns.rows(), 0);
    return gain;
  }
  gain.removed = (gain.basis.transpose() * y).squaredNorm();
  const auto k = static_cast<double>(gain.basis.cols());
  gain.p = RemovalTail(gain.removed, k, y.squaredNorm(), dof, sigma_known);
  return gain;
}

/// The file with the effects of a joint fit; curves, of which the readings are linear and which
/// have hundreds of coefficients, at their values there.
ProblemSpec WithEffects(const ProblemSpec& spec, const CompleteFit& joint) {
  ProblemSpec with = spec;
  with.parameters.effects = WithValues(joint.calibration.effects, joint);
  const PhysicsContext context = joint.calibration.Context();
  for (std::size_t k = 0; k < with.parameters.effects.size(); ++k) {
    EffectRequest& effect = with.parameters.effects[k];
    if (joint.calibration.effects[k].held) {
      effect = joint.calibration.effects[k];
    } else {
      effect.held = EffectColumns(context, effect).front().prior_sigma > 0;
    }
  }
  return with;
}

/// The rows at the file's own geometry and the physics, and what these two can do.
struct OwnModel {
  std::unique_ptr<DesignRows> rows;
  Eigen::MatrixXd U;
  Eigen::VectorXd y;
};

OwnModel OwnModelAt(const Calibration& user,
                    const Eigen::VectorXd& state,
                    const Noise& noise,
                    const std::vector<Reading>& readings) {
  OwnModel own;
  own.rows = std::make_unique<DesignRows>(user, state, noise, readings);
  std::vector<Parameter> geometry, physics;
  for (const Parameter& p : user.parameters) {
    (p.effect_column < 0 ? geometry : physics).push_back(p);
  }
  // Only what the file's fit can move within the tolerances: near parallel axes plain DH rows can
  // imitate a tilt, with corrections of metres.
  const Eigen::MatrixXd J = own.rows->Geometry(geometry);
  own.U = BasisAbove(J * ScalesOf(geometry).tolerance.asDiagonal(), 1.0);
  if (!physics.empty()) {
    const Eigen::MatrixXd more =
        OrthonormalBasis(ProjectOff(own.U, own.rows->Geometry(physics)), 1e-6);
    own.U.conservativeResize(own.rows->num_rows(), own.U.cols() + more.cols());
    own.U.rightCols(more.cols()) = more;
  }
  own.y = ProjectOff(own.U, own.rows->y());
  return own;
}

/// True if a joint fit leaves no more than the stated noise: else that noise is no measure.
bool MeetsStatedNoise(const CompleteFit& joint,
                      const std::vector<Reading>& readings,
                      double false_alarm) {
  if (!SourceOfNoise(joint.calibration).all_given()) return false;
  const CleanRows left = TakeOutModel(joint, readings);
  return ChiSquareTail(left.y.squaredNorm(), left.nu) > false_alarm;
}

/// True if some parameter of a finding differs from zero by what a finding must.
bool DiffersFromZero(const Finding& finding) {
  constexpr double kSigmas = 2;
  return std::any_of(
      finding.parameters.begin(), finding.parameters.end(), [](const FoundParameter& p) {
        return std::abs(p.value) >= kSigmas * p.sigma;
      });
}

/// Adds the completions that the rows ask for beside the file's own model, the strongest first.
void AddNeeded(const std::vector<Completion>& completions,
               const CompleteFit& joint,
               bool sigma_known,
               OwnModel own,
               DiagnosisResult* geometry) {
  const double level =
      kShareOfGeometry * geometry->false_alarm / static_cast<double>(completions.size());
  const auto rms = [&] {
    return RmsAsRead(joint.calibration, joint.fit.noise_seen, own.rows->now_row(), own.y);
  };
  std::vector<bool> used(completions.size(), false);
  while (true) {
    std::size_t best = completions.size();
    Gain best_gain;
    for (std::size_t k = 0; k < completions.size(); ++k) {
      if (used[k]) continue;
      const Eigen::MatrixXd J = own.rows->Geometry(completions[k].parameters);
      const auto dof = static_cast<double>(own.rows->degrees_of_freedom() - own.U.cols());
      const Gain gain = GainOf(own.U, J, own.y, dof, sigma_known);
      if (gain.p > level) continue;
      if (best < completions.size() && gain.removed <= best_gain.removed) continue;
      best = k;
      best_gain = gain;
    }
    if (best == completions.size()) break;
    used[best] = true;
    Finding finding =
        DescribeCompletion(completions[best], joint.calibration, joint.fit, best_gain.p);
    if (!DiffersFromZero(finding)) continue;
    own.U.conservativeResize(Eigen::NoChange, own.U.cols() + best_gain.basis.cols());
    own.U.rightCols(best_gain.basis.cols()) = best_gain.basis;
    finding.rms_train_before = rms();
    own.y = ProjectOff(best_gain.basis, own.y);
    finding.rms_train_after = rms();
    geometry->findings.push_back(finding);
  }
}

/// Geometry comes first.
void Take(DiagnosisResult geometry, DiagnosisResult* d) {
  d->findings.insert(d->findings.begin(), geometry.findings.begin(), geometry.findings.end());
  d->moved.insert(d->moved.begin(), geometry.moved.begin(), geometry.moved.end());
  d->notes.insert(d->notes.end(), geometry.notes.begin(), geometry.notes.end());
}

}  // namespace

void AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& joint,
                        const Readings& readings,
                        DiagnosisResult* d) {
  const ProblemSpec with_effects = WithEffects(spec, joint);
  const std::vector<Completion> missing =
      MissingCompletions(Calibration(with_effects, recording), joint.calibration);
  if (missing.empty()) return;
  DiagnosisResult geometry;
  geometry.false_alarm = spec.diagnosis.false_alarm;
  const auto held =
      AddConcealedFrames(with_effects, recording, identified, joint, missing, &geometry);
  // From the file's own answer, all corrections in it; where a frame was concealed or there is no
  // answer, from that of the fit held to the drawing.
  ProblemSpec user_spec = held->spec;
  user_spec.measurement = spec.measurement;
  user_spec.robot = identified.calibrated;
  const bool concealed = !geometry.findings.empty();
  if ((concealed || identified.best() == nullptr) && held->usable()) {
    user_spec.robot = CalibratedRobot(held->calibration, held->state());
  } else if (concealed || identified.best() == nullptr) {
    return Take(std::move(geometry), d);
  }
  Calibration user(user_spec, recording);
  user.readings = readings;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(user.parameters.size()));
  if (!user.effects.empty()) {
    // The file's answer knows nothing of the physics that was found.
    const Fit fit = RunFit(user,
                           SolverMethod::kSvdGaussNewton,
                           OptionsOf(user_spec.solver),
                           InitialNoise(user),
                           Progress());
    if (!fit.summary.IsSolutionUsable()) return Take(std::move(geometry), d);
    state = fit.summary.state;
  }
  const std::vector<Completion> completions = MissingCompletions(user, joint.calibration);
  if (!completions.empty()) {
    const bool sigma_known = MeetsStatedNoise(joint, readings.fitted, spec.diagnosis.false_alarm);
    AddNeeded(completions,
              joint,
              sigma_known,
              OwnModelAt(user, state, joint.fit.noise_seen, readings.fitted),
              &geometry);
  }
  const bool found = !geometry.findings.empty();
  Take(std::move(geometry), d);
  if (!found || completions.empty() || readings.test.empty() || !d->model.empty()) return;
  // Rows never fitted: by the file's own answer, and by the complete geometry.
  const DesignRows own(user, state, joint.fit.noise_seen, readings.test);
  d->validation_method = "set column";
  d->rms_test_before = RmsAsRead(user, joint.fit.noise_seen, own.now_row(), own.y());
  d->rms_test_after = RmsOfReadings(joint, readings.test);
}

}  // namespace dhcal
