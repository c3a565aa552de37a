#include "problems/diagnosis/completions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/fit_analysis.h"
#include "problems/parameter_values.h"

namespace dhcal {
namespace {

constexpr double kKnown = 1.0 / 3;  // sigma of a parameter worth naming, in tolerances

}  // namespace

std::vector<Completion> MissingCompletions(const Calibration& user, const Calibration& complete) {
  std::set<std::string> estimated;
  for (const Parameter& p : user.parameters) estimated.insert(p.name);
  std::vector<Completion> completions;
  Completion base, tool;
  base.request.effect = "base_frame";
  tool.request.effect = "tool_offset";
  for (const Parameter& p : complete.parameters) {
    if (estimated.count(p.name) > 0) continue;
    if (p.group == ParameterGroup::kBase) base.parameters.push_back(p);
    if (p.group == ParameterGroup::kTool) tool.parameters.push_back(p);
    if (p.group != ParameterGroup::kBeta) continue;
    Completion tilt;
    tilt.request.effect = "axis_tilt";
    tilt.request.joint = SlotLayout::JointOf(p.slot) + 1;
    tilt.parameters.push_back(p);
    completions.push_back(tilt);
  }
  if (!base.parameters.empty()) completions.push_back(base);
  if (!tool.parameters.empty()) completions.push_back(tool);
  return completions;
}

ProblemSpec WithCompletion(const ProblemSpec& spec, const Completion& completion) {
  // What 'fix' takes away from a group would stay away: the names that remain are listed one by
  // one.
  ProblemSpec wider = spec;
  std::vector<std::string>& fix = wider.parameters.fix;
  for (const Parameter& p : completion.parameters) {
    wider.parameters.estimate.push_back(p.name);
    const std::string without_scope = p.name.substr(0, p.name.find('.'));
    fix.erase(std::remove_if(fix.begin(),
                             fix.end(),
                             [&](const std::string& entry) {
                               return entry == p.name || entry == without_scope ||
                                      entry == ToString(p.group);
                             }),
              fix.end());
  }
  return wider;
}

Finding DescribeCompletion(const Completion& completion,
                           const Calibration& c,
                           const Fit& fit,
                           double p_value) {
  const std::optional<FitAnalysis> analysis = Analyse(c, fit);
  const double quantile = StudentTwoSided(0.95, analysis ? analysis->degrees_of_freedom : 1.0);
  const RobotModel& nominal = c.spec.robot;
  const RobotModel calibrated = CalibratedRobot(c, fit.summary.state);
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
    const auto own =
        std::find_if(c.parameters.begin(), c.parameters.end(), [&](const Parameter& p) {
          return p.name == completion.parameters[i].name;
        });
    if (own == c.parameters.end()) continue;
    const auto row = own - c.parameters.begin();
    // The column of the parameter's own slot: a file may estimate the others of the frame already.
    const auto column = std::find_if(columns.begin(), columns.end(), [&](const EffectColumn& e) {
      return e.slots.front().slot == own->slot;
    });
    if (column == columns.end()) continue;
    FoundParameter found;
    found.name = ParameterName(completion.request, column->parameter);
    found.value = Correction(nominal, frames_nominal, calibrated, frames, *own);
    found.sigma = analysis ? std::sqrt(analysis->identifiability.covariance(row, row))
                           : std::numeric_limits<double>::infinity();
    found.ci95_low = found.value - quantile * found.sigma;
    found.ci95_high = found.value + quantile * found.sigma;
    found.unit = column->unit;
    finding.parameters.push_back(found);
    // Frames may come once per run or target: the sentence speaks of the first.
    const bool first = std::none_of(values.begin(), values.end(), [&](const EffectValue& v) {
      return v.parameter == column->parameter;
    });
    if (first && found.sigma <= kKnown * own->tolerance) {
      values.push_back({column->parameter, column->unit, found.value, found.sigma});
    }
  }
  finding.sentence = effect.Sentence(context, completion.request, values);
  return finding;
}

}  // namespace dhcal
