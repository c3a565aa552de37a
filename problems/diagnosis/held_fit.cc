#include "problems/diagnosis/held_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/joint_numbers.h"
#include "problems/noise.h"
#include "problems/parameter_set.h"
#include "problems/start.h"

namespace dhcal {
namespace {

bool IsRowDimension(const Parameter& p) { return NumberOf(p.group) != nullptr; }

ProblemSpec HeldSpec(const ProblemSpec& user, const Noise& noise) {
  ProblemSpec spec = user;
  spec.solver.loss = LossKind::kNone;
  spec.solver.rule = TruncationRule::kNoise;
  // Fits are compared by their chi-square, so all have the same noise.
  spec.measurement.sigma = user.measurement.sigma.value_or(noise.sigma);
  spec.measurement.sigma_rotation = user.measurement.sigma_rotation.value_or(noise.sigma_rotation);
  return spec;
}

}  // namespace

HeldFit::HeldFit(const ProblemSpec& user_spec, const Recording& recording, const Noise& noise)
    : spec(HeldSpec(user_spec, noise)), calibration(spec, recording) {}

std::unique_ptr<HeldFit> FitHeld(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Noise& noise) {
  auto result = std::make_unique<HeldFit>(spec, recording, noise);
  Calibration& c = result->calibration;
  for (Parameter& p : c.parameters) {
    if (IsRowDimension(p) && !p.prior_sigma) p.prior_sigma = p.tolerance;
  }
  AlignStart(&c);
  FitFramesAlone(&c, {});
  result->fit = RunFit(c, SettingsOf(c));
  return result;
}

std::vector<RowCorrection> ImplausibleCorrections(const HeldFit& fit) {
  std::vector<RowCorrection> implausible;
  for (std::size_t k = 0; k < fit.calibration.parameters.size(); ++k) {
    const RowCorrection correction{fit.calibration.parameters[k],
                                   fit.state()[static_cast<Eigen::Index>(k)]};
    if (!IsRowDimension(correction.parameter)) continue;
    if (correction.tolerances() > kPlausibleTolerances) implausible.push_back(correction);
  }
  std::sort(implausible.begin(), implausible.end(), [](const auto& a, const auto& b) {
    return a.tolerances() > b.tolerances();
  });
  return implausible;
}

double Penalty(const HeldFit& fit) {
  double penalty = 0;
  for (std::size_t k = 0; k < fit.calibration.parameters.size(); ++k) {
    const RowCorrection correction{fit.calibration.parameters[k],
                                   fit.state()[static_cast<Eigen::Index>(k)]};
    if (IsRowDimension(correction.parameter)) {
      penalty += correction.tolerances() * correction.tolerances();
    }
  }
  return penalty;
}

bool RowsPlausible(const RobotModel& nominal, const RobotModel& calibrated) {
  for (std::size_t k = 0; k < nominal.joints.size() && k < calibrated.joints.size(); ++k) {
    for (const JointNumber& number : kJointNumbers) {
      const double change = calibrated.joints[k].*number.value - nominal.joints[k].*number.value;
      if (std::abs(change) > kPlausibleTolerances * number.tolerance) return false;
    }
  }
  return true;
}

}  // namespace dhcal
