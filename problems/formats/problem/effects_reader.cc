#include "problems/formats/problem/effects_reader.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/physics/registry.h"

namespace dhcal {

namespace {

const std::vector<std::pair<std::string, DiagnosisRun>> kRuns = {{"auto", DiagnosisRun::kAuto},
                                                                 {"always", DiagnosisRun::kAlways},
                                                                 {"never", DiagnosisRun::kNever}};

/// Name of an effect of the library; an error names the nearest.
const Effect* EffectNamed(const YamlValue& value) {
  const std::optional<std::string> name = value.Text();
  if (!name) return nullptr;
  const Effect* const effect = FindEffect(*name);
  if (effect != nullptr) return effect;
  const std::string nearest = NearestName(*name, EffectNames());
  value.Error(fmt::format("is '{}', which is no effect of the library{}; see --list_effects",
                          Printable(*name),
                          nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
  return nullptr;
}

/// `values: {compliance: 3e-6}`, SI; which parameters there are may depend on the recording.
void ReadValues(YamlMap* map, bool required, EffectRequest* request) {
  const std::optional<YamlValue> values = required ? map->Require("values") : map->Find("values");
  if (!values) return;
  YamlMap entries(*values);
  for (const auto& [parameter, value] : entries.AllEntries()) {
    if (const std::optional<double> number = value.Number()) request->values[parameter] = *number;
  }
  if (entries.valid() && request->values.empty() && values->node().size() == 0) {
    values->Error("names no parameter; write for instance {compliance: 3.0e-6}, in SI units");
  }
}

/// A setting's number, after an error 0.
double ReadSetting(const std::string& key, const RobotModel& robot, YamlMap* map) {
  if (const std::optional<WholeRange> range = WholeSetting(key, robot.num_joints())) {
    int number = 0;
    map->Read(key, &number, range->low, range->high);
    return number;
  }
  double number = 0;
  map->Read(key, &number);
  return number;
}

void ReadEffect(const YamlValue& item,
                const RobotModel& robot,
                bool with_values,
                std::vector<EffectRequest>* effects) {
  YamlMap map(item);
  if (!map.valid()) return;
  const std::optional<YamlValue> name = map.Require("effect");
  const Effect* const effect = name ? EffectNamed(*name) : nullptr;
  if (effect == nullptr) {
    map.AcceptAllKeys();
    return;
  }
  const EffectDescription description = effect->Describe();
  EffectRequest request;
  request.effect = description.name;
  request.where = item.where();
  map.set_remark(fmt::format("of effect '{}'", description.name));
  if (description.has_joint && map.RequireKey("joint")) {
    map.Read("joint", &request.joint, 1, std::max(robot.num_joints(), 1));
  }
  for (const auto& [key, meaning] : description.settings) {
    if (!map.Has(key)) continue;
    if (IsWord(key)) {
      map.Read(key, &request.words[key]);
    } else {
      request.settings[key] = ReadSetting(key, robot, &map);
    }
  }
  ReadValues(&map, with_values, &request);
  request.held = !with_values && !request.values.empty();
  const auto same = [&](const EffectRequest& other) { return other.SameAs(request); };
  if (std::any_of(effects->begin(), effects->end(), same)) {
    return item.Error("asks for the same effect a second time; keep one of them");
  }
  effects->push_back(request);
}

}  // namespace

void ReadEffects(YamlMap* map,
                 const RobotModel& robot,
                 bool with_values,
                 std::vector<EffectRequest>* effects) {
  const std::optional<YamlValue> value = map->Find("effects");
  if (!value) return;
  const auto items = value->List();
  if (!items) return;
  for (const YamlValue& item : *items) ReadEffect(item, robot, with_values, effects);
}

bool ParseDiagnosisRun(std::string_view text, DiagnosisSpec* diagnosis) {
  for (const auto& [name, run] : kRuns) {
    if (name != text) continue;
    diagnosis->run = run;
    return true;
  }
  return false;
}

void ReadDiagnosis(const YamlValue& value, DiagnosisSpec* diagnosis) {
  YamlMap map(value);
  if (!map.valid()) return;
  map.ReadChoice<DiagnosisRun>("run", kRuns, &diagnosis->run);
  map.Read("false_alarm", &diagnosis->false_alarm, Range::Inside(0, 0.5));
  const std::optional<YamlValue> effects = map.Find("effects");
  if (!effects) return;
  if (effects->node().IsScalar() && effects->node().Scalar() == "all") return;
  if (!effects->IsList()) return effects->Error("is neither 'all' nor a list of effects");
  for (const YamlValue& item : effects->List().value_or(std::vector<YamlValue>())) {
    if (const Effect* const effect = EffectNamed(item)) {
      diagnosis->effects.push_back(effect->Describe().name);
    }
  }
  if (effects->IsEmptyList()) effects->Error("names no effect; write 'all' or leave it out");
}

}  // namespace dhcal
