#include "problems/describe_parameters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/physics/effect.h"
#include "problems/parameter_set.h"
#include "problems/parameter_values.h"

namespace dhcal {
namespace {

/// "0.21 mm", "0.34 mrad".
std::string Length(double value, Unit unit) {
  switch (unit) {
    case Unit::kMetre:
      return fmt::format("{:.2g} mm", value / kMillimetre);
    case Unit::kRadian:
      return fmt::format("{:.2g} mrad", value / kMilliradian);
    case Unit::kOther:
      return fmt::format("{:.2g} (SI)", value);
  }
  return "";
}

bool Holds(const NullDirection& n, const std::string& name) {
  return std::any_of(n.direction.begin(), n.direction.end(), [&](const auto& entry) {
    return entry.name == name;
  });
}

/// The first sentence on an undetermined direction that holds the parameter, and the names of all
/// others that its directions, or directions of the same sentence, hold.
void Confounded(const std::vector<NullDirection>& null_space, ParameterResult* result) {
  for (const NullDirection& n : null_space) {
    if (result->explanation.empty() && Holds(n, result->name)) result->explanation = n.explanation;
  }
  std::set<std::string> others;
  for (const NullDirection& n : null_space) {
    if (!Holds(n, result->name) && n.explanation != result->explanation) continue;
    for (const auto& entry : n.direction) others.insert(entry.name);
  }
  others.erase(result->name);
  result->confounded_with.assign(others.begin(), others.end());
}

void Explain(const Determination& d,
             const Parameter& parameter,
             double tolerance,
             const std::vector<NullDirection>& null_space,
             ParameterResult* result) {
  switch (d.verdict) {
    case Verdict::kUnobservable:
      Confounded(null_space, result);
      if (!result->explanation.empty()) return;
      result->explanation = fmt::format(
          "its tolerance of {} moves the readings by less than their noise, even if all other "
          "parameters were known",
          Length(tolerance, parameter.unit));
      return;
    case Verdict::kConfounded:
      Confounded(null_space, result);
      return;
    case Verdict::kWeak:
      result->explanation = fmt::format(
          "known to {} (one sigma), tolerance {}; {} of it hidden among other parameters",
          Length(result->sigma, parameter.unit),
          Length(tolerance, parameter.unit),
          Length(d.hidden * tolerance, parameter.unit));
      return;
    case Verdict::kIdentified:
    case Verdict::kFixed:
      return;
  }
}

/// Slots that free curves move, with the curve. A curve holds a constant, and only its prior
/// keeps it from taking the slot's own: both are known together, neither for itself.
std::map<int, EffectRequest> SlotsOfCurves(const Calibration& c) {
  std::map<int, EffectRequest> curves;
  for (const Parameter& parameter : c.parameters) {
    if (parameter.effect_column < 0 || c.ColumnOf(parameter).prior_sigma <= 0) continue;
    for (const SlotWeights& slot : c.ColumnOf(parameter).slots) {
      curves[slot.slot] = c.EffectOf(parameter.effect_column);
    }
  }
  return curves;
}

void ConfoundWithCurve(const EffectRequest& curve, ParameterResult* result) {
  if (result->verdict != Verdict::kIdentified && result->verdict != Verdict::kWeak) return;
  result->verdict = Verdict::kConfounded;
  result->confounded_with = {fmt::format("{}.{}", curve.effect, curve.joint)};
  result->explanation = fmt::format(
      "{} has a constant of its own, and only their sum moves the readings: rely on both together",
      InstanceName(curve));
}

}  // namespace

std::vector<ParameterResult> DescribeParameters(const Calibration& c,
                                                const Eigen::VectorXd& state,
                                                const FitAnalysis& analysis,
                                                const std::vector<NullDirection>& null_space) {
  const RobotModel& nominal = c.spec.robot;
  const RobotModel calibrated = CalibratedRobot(c, state);
  const Frames frames_nominal(nominal, c.recording), frames(calibrated, c.recording);
  const double quantile = StudentTwoSided(0.95, analysis.degrees_of_freedom);
  const std::map<int, EffectRequest> curves = SlotsOfCurves(c);
  std::vector<ParameterResult> results;
  const auto start = [&](const Parameter& parameter) {
    ParameterResult result;
    result.name = parameter.name;
    result.unit = parameter.unit;
    result.unit_text = parameter.unit_text;
    result.nominal = ValueIn(nominal, frames_nominal, parameter);
    result.value = ValueIn(calibrated, frames, parameter);
    result.correction = Correction(nominal, frames_nominal, calibrated, frames, parameter);
    return result;
  };
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const Parameter& parameter = c.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    const Determination& d = analysis.identifiability.parameters[k];
    ParameterResult result = start(parameter);
    // An effect is absent from the nominal robot and stands in no robot model.
    if (parameter.effect_column >= 0) result.value = result.correction = state[i];
    result.sigma = std::sqrt(analysis.identifiability.covariance(i, i));
    result.ci95_low = result.value - quantile * result.sigma;
    result.ci95_high = result.value + quantile * result.sigma;
    result.verdict = d.verdict;
    Explain(d, parameter, analysis.identifiability.readings.scale[i], null_space, &result);
    const auto curve = curves.find(parameter.slot);
    if (parameter.effect_column < 0 && curve != curves.end()) {
      ConfoundWithCurve(curve->second, &result);
    }
    results.push_back(result);
  }
  for (const Parameter& parameter : ResolveParameters(c.spec, c.recording).fixed) {
    ParameterResult result = start(parameter);
    result.verdict = Verdict::kFixed;
    results.push_back(result);
  }
  return results;
}

}  // namespace dhcal
