// Sentences for the directions that the readings do not determine.
#ifndef DHCAL_CORE_ANALYSIS_NULL_SPACE_WORDS_H_
#define DHCAL_CORE_ANALYSIS_NULL_SPACE_WORDS_H_

#include <vector>

#include "core/model/parameter.h"
#include "core/model/problem_spec.h"
#include "core/model/result.h"
#include "core/model/robot.h"

namespace dhcal {

/// Fills the explanation of each direction: what is determined instead, and why. Geometry is named
/// as the reason for a single parameter only where it moves no reading, as the nominal robot has
/// it; elsewhere its prior or tolerance is tighter than what the readings say.
void WriteExplanations(const RobotModel& robot,
                       const MeasurementKind& kind,
                       const std::vector<Parameter>& parameters,
                       std::vector<NullDirection>* directions);

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_NULL_SPACE_WORDS_H_
