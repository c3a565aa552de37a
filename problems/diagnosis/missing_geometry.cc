#include "problems/diagnosis/missing_geometry.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/assembly.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/projection.h"
#include "problems/fit_analysis.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"

namespace dhcal {
namespace {

/// A completion: the effect that names it and the parameters that it frees.
struct Completion {
  EffectRequest request;
  std::vector<std::size_t> parameters;  // of the complete calibration
};

std::vector<Completion> Missing(const Calibration& user, const Calibration& complete) {
  std::set<std::string> estimated;
  for (const Parameter& p : user.parameters) estimated.insert(p.name);
  std::vector<Completion> completions;
  Completion base, tool;
  base.request.effect = "base_frame";
  tool.request.effect = "tool_offset";
  for (std::size_t k = 0; k < complete.parameters.size(); ++k) {
    const Parameter& p = complete.parameters[k];
    if (estimated.count(p.name) > 0) continue;
    if (p.group == ParameterGroup::kBase) base.parameters.push_back(k);
    if (p.group == ParameterGroup::kTool) tool.parameters.push_back(k);
    if (p.group != ParameterGroup::kBeta) continue;
    Completion tilt;
    tilt.request.effect = "axis_tilt";
    tilt.request.joint = p.slot / SlotLayout::kPerJoint + 1;
    tilt.parameters.push_back(k);
    completions.push_back(tilt);
  }
  if (!base.parameters.empty()) completions.push_back(base);
  if (!tool.parameters.empty()) completions.push_back(tool);
  return completions;
}

struct Gain {
  double p = 1;
  double removed = 0;
  Eigen::MatrixXd basis;
};

Gain GainOf(const Eigen::MatrixXd& U,
            const Eigen::MatrixXd& columns,
            const Eigen::VectorXd& y,
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
  const double rest = static_cast<double>(y.size() - U.cols()) - k;
  if (sigma_known) {
    gain.p = ChiSquareTail(gain.removed, k);
  } else if (rest >= 1) {
    const double left = std::max(y.squaredNorm() - gain.removed, 1e-300);
    gain.p = FTail(gain.removed / k / (left / rest), k, rest);
  }
  return gain;
}

Finding Describe(const Completion& completion, const CompleteFit& fit, double p_value) {
  const Calibration& c = fit.calibration;
  const FitAnalysis analysis = Analyse(c, fit.fit);
  const RobotModel& nominal = c.spec.robot;
  const RobotModel calibrated = CalibratedRobot(c, fit.state());
  const Frames frames_nominal(nominal, c.recording), frames(calibrated, c.recording);
  Finding finding;
  finding.effect = completion.request;
  const Effect& effect = *FindEffect(completion.request.effect);
  const PhysicsContext context = c.Context();
  const EffectPlace place = effect.Place(context, completion.request);
  finding.effect_class = place.effect_class;
  finding.location = place.location;
  finding.driver = place.driver;
  finding.p_value = p_value;
  const std::vector<EffectColumn> columns = effect.Columns(context, completion.request);
  std::vector<EffectValue> values;
  for (std::size_t i = 0; i < completion.parameters.size(); ++i) {
    const std::size_t k = completion.parameters[i];
    const auto row = static_cast<Eigen::Index>(k);
    const Parameter& p = c.parameters[k];
    // Frames may come once per run or target; their six follow each other.
    const EffectColumn& column = columns[i % columns.size()];
    FoundParameter found;
    found.name = ParameterName(completion.request, column.parameter);
    found.value = Correction(nominal, frames_nominal, calibrated, frames, p);
    found.sigma = std::sqrt(analysis.identifiability.covariance(row, row));
    found.ci95_low = found.value - 1.96 * found.sigma;
    found.ci95_high = found.value + 1.96 * found.sigma;
    found.unit = column.unit;
    finding.parameters.push_back(found);
    if (i < columns.size() &&
        analysis.identifiability.parameters[k].verdict == Verdict::kIdentified) {
      values.push_back({column.parameter, column.unit, found.value, found.sigma});
    }
  }
  finding.sentence = effect.Sentence(completion.request, values);
  return finding;
}

}  // namespace

void AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& complete,
                        DiagnosisResult* d) {
  // At the file's own answer: its robot, all corrections in it.
  ProblemSpec user_spec = spec;
  user_spec.robot = identified.calibrated;
  const Calibration user(user_spec, recording);
  const std::vector<Completion> completions = Missing(user, complete.calibration);
  if (completions.empty()) return;
  const Eigen::VectorXd zero =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(user.parameters.size()));
  const DesignRows rows(user, zero, complete.fit.noise_seen, user.readings.fitted);
  // Only what the file's fit can move within the tolerances: near parallel axes plain DH rows can
  // imitate a tilt, with corrections of metres.
  Eigen::MatrixXd J_user = rows.Geometry(user.parameters);
  const Eigen::VectorXd tolerance = ScalesOf(user.parameters).tolerance;
  J_user.leftCols(tolerance.size()) =
      J_user.leftCols(tolerance.size()).eval() * tolerance.asDiagonal();
  Eigen::MatrixXd U = BasisAbove(J_user, 1.0);
  Eigen::VectorXd y = ProjectOff(U, rows.y());
  const bool sigma_known = SourceOfNoise(user).all_given();
  std::vector<bool> used(completions.size(), false);
  while (true) {
    std::size_t best = completions.size();
    Gain best_gain;
    for (std::size_t k = 0; k < completions.size(); ++k) {
      if (used[k]) continue;
      std::vector<Parameter> parameters;
      for (const std::size_t i : completions[k].parameters) {
        parameters.push_back(complete.calibration.parameters[i]);
      }
      const Eigen::MatrixXd J = rows.Geometry(parameters);
      const Gain gain =
          GainOf(U, J.leftCols(static_cast<Eigen::Index>(parameters.size())), y, sigma_known);
      if (gain.p > spec.diagnosis.false_alarm / static_cast<double>(completions.size())) continue;
      if (best < completions.size() && gain.removed <= best_gain.removed) continue;
      best = k;
      best_gain = gain;
    }
    if (best == completions.size()) break;
    used[best] = true;
    Eigen::MatrixXd wider(U.rows(), U.cols() + best_gain.basis.cols());
    wider << U, best_gain.basis;
    U = wider;
    const double sigma = complete.fit.noise_seen.sigma;
    const double rms_before = sigma * std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    y = ProjectOff(best_gain.basis, y);
    Finding finding = Describe(completions[best], complete, best_gain.p);
    finding.rms_train_before = rms_before;
    finding.rms_train_after = sigma * std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    d->findings.push_back(finding);
  }
}

}  // namespace dhcal
