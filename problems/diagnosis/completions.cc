#include "problems/diagnosis/completions.h"

#include <algorithm>
#include <cmath>
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
  for (const Parameter& p : complete.parameters) {
    if (estimated.count(p.name) > 0) continue;
    const Effect* const effect = EffectThatCompletes(p.group);
    if (effect == nullptr) continue;
    const bool of_joint = effect->Describe().has_joint;
    const EffectRequest request =
        effect->Request(of_joint ? p.slot / SlotLayout::kPerJoint + 1 : 0);
    const auto same = [&](const Completion& known) { return known.request.SameAs(request); };
    auto completion = std::find_if(completions.begin(), completions.end(), same);
    if (completion == completions.end()) {
      completions.emplace_back();
      completion = completions.end() - 1;
      completion->request = request;
    }
    completion->parameters.push_back(p);
  }
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
  const FitAnalysis analysis = Analyse(c, fit);
  const double quantile = StudentTwoSided(0.95, analysis.degrees_of_freedom);
  const RobotModel& nominal = c.spec.robot;
  const RobotModel calibrated = CalibratedRobot(c, fit.summary.state);
  const Frames frames_nominal(nominal, c.recording), frames(calibrated, c.recording);
  Finding finding;
  finding.effect = completion.request;
  const Effect& effect = *FindEffect(completion.request.effect);
  const PhysicsContext context = c.Context();
  const EffectPlace place = effect.Place(context, completion.request);
  finding.effect_class = ToString(place.effect_class);
  finding.is_geometry = true;
  finding.location = place.location;
  finding.driver = DriverWords(place.driver, completion.request.joint);
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
    found.sigma = std::sqrt(analysis.identifiability.covariance(row, row));
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
  finding.sentence = effect.Sentence(completion.request, values);
  return finding;
}

}  // namespace dhcal
