// Geometric freedoms that the problem file holds fixed although the readings ask for them
// (physics.md X1), judged beside the physics that was found: strong physics asks for any of them.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_

#include <vector>

#include "core/model/diagnosis.h"
#include "core/model/result.h"
#include "problems/diagnosis/complete_fit.h"

namespace dhcal {

/// Share of the false-alarm rate that these tests may spend; the rest is the search's.
constexpr double kShareOfGeometry = 0.2;

/// Tests the frames and tilts that complete the geometry, as far as the file leaves them out, at
/// the file's own geometry fitted together with the physics found (`diagnosis->model`); adds a
/// finding for each that is needed, before the physics, with its size from `joint`: the complete
/// geometry fitted with that physics. `readings`: those to judge by, outliers excluded.
void AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& joint,
                        const Readings& readings,
                        DiagnosisResult* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
