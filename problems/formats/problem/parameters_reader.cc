#include "problems/formats/problem/parameters_reader.h"

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "problems/formats/problem/effects_reader.h"
#include "problems/formats/problem/parameter_names.h"

namespace dhcal {

namespace {

struct PriorUnit {
  std::string suffix;
  double to_si;
  bool angle;
};

const std::vector<PriorUnit>& PriorUnits() {
  static const std::vector<PriorUnit> units = {{"_m", 1.0, false},
                                               {"_mm", kMillimetre, false},
                                               {"_rad", 1.0, true},
                                               {"_deg", kDegree, true},
                                               {"_mrad", kMilliradian, true}};
  return units;
}

/// A list of names, or one name alone.
std::vector<YamlValue> NameValues(const YamlValue& value) {
  if (!value.IsList()) return {value};
  return value.List().value_or(std::vector<YamlValue>());
}

void ReadNames(YamlMap* map,
               const std::string& key,
               const RobotModel& robot,
               bool may_be_complete,
               std::vector<std::string>* names) {
  const std::optional<YamlValue> value = map->Find(key);
  if (!value) return;
  names->clear();
  for (const YamlValue& item : NameValues(*value)) {
    const std::optional<std::string> name = item.Text();
    if (!name) continue;
    std::string problem;
    const bool complete = *name == "complete" && may_be_complete;
    if (complete || ClassifyParameterName(*name, robot, &problem)) {
      names->push_back(*name);
    } else {
      item.Error(fmt::format("is '{}', which {}", Printable(*name), problem));
    }
  }
}

/// Splits "theta3_deg" into the name and its unit; reports what does not fit together.
void ReadPrior(const std::string& key,
               const YamlValue& value,
               const RobotModel& robot,
               ParameterSpec* parameters) {
  const auto refuse = [&](const std::string& what) {
    value.source()->Error(value.key_where(), value.QuotedName() + " " + what);
  };
  const PriorUnit* unit = nullptr;
  for (const PriorUnit& candidate : PriorUnits()) {
    if (EndsWith(key, candidate.suffix)) unit = &candidate;
  }
  if (unit == nullptr) {
    return refuse("must end in its unit: _m or _mm for a length, _deg, _rad or _mrad for an angle");
  }
  std::string name = key.substr(0, key.size() - unit->suffix.size());
  std::string problem;
  const std::optional<NameKind> kind = ClassifyParameterName(name, robot, &problem);
  if (!kind) return refuse(problem);
  if (*kind == (unit->angle ? NameKind::kLength : NameKind::kAngle)) {
    return refuse(unit->angle ? "is a length, but its unit is one of an angle; use _m or _mm"
                              : "is an angle, but its unit is one of a length; use _deg or _rad");
  }
  if (*kind == NameKind::kLengthsAndAngles) name += unit->angle ? ":rad" : ":m";
  const std::optional<double> sigma = value.Number(Range::Above(0));
  if (!sigma) return;
  if (!parameters->prior_sigma.emplace(name, *sigma * unit->to_si).second) {
    refuse("gives the same quantity a second time in another unit; keep one of them");
  }
}

}  // namespace

void ReadParameters(const YamlValue& value, const RobotModel& robot, ParameterSpec* parameters) {
  YamlMap map(value);
  const int errors_before = value.source()->num_errors();
  ReadNames(&map, "estimate", robot, true, &parameters->estimate);
  const bool names_read = value.source()->num_errors() == errors_before;
  if (parameters->estimate.empty() && names_read) {
    map.Find("estimate")
        ->Error("names nothing to estimate; name groups such as theta, alpha, a, d");
  }
  ReadNames(&map, "fix", robot, false, &parameters->fix);
  if (const std::optional<YamlValue> priors = map.Find("prior_sigma")) {
    YamlMap prior_map(*priors);
    for (const auto& [key, prior] : prior_map.AllEntries()) {
      ReadPrior(key, prior, robot, parameters);
    }
  }
  ReadEffects(&map, robot, /*with_values=*/false, &parameters->effects);
}

}  // namespace dhcal
