// Reads `parameters.effects`, `simulate.effects` and `diagnosis` (FORMATS.md, section 2).
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECTS_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECTS_READER_H_

#include <string_view>
#include <vector>

#include "core/io/yaml_map.h"
#include "core/model/problem_spec.h"

namespace dhcal {

/// The key `effects` of a map: a list of effects with their settings. `with_values`: each must say
/// how large it is.
void ReadEffects(YamlMap* map,
                 const RobotModel& robot,
                 bool with_values,
                 std::vector<EffectRequest>* effects);

/// "auto", "always", "never"; false for anything else.
bool ParseDiagnosisRun(std::string_view text, DiagnosisSpec* diagnosis);

void ReadDiagnosis(const YamlValue& value, DiagnosisSpec* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECTS_READER_H_
