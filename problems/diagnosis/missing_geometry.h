// Geometric freedoms that the problem file holds fixed although the readings ask for them: named
// as geometry before anything is called physics (PHYSICS.md X1).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_

#include <vector>

#include "core/model/diagnosis.h"
#include "core/model/result.h"
#include "problems/diagnosis/complete_fit.h"

namespace dhcal {

/// Share of the false-alarm rate that these tests may spend; the rest is the search's.
constexpr double kShareOfGeometry = 0.2;

/// Tests axis_tilt, base_frame and tool_offset, as far as the file leaves them out, at the file's
/// own fit; adds a finding for each that is needed, with its size from the complete fit.
/// `readings`: those to judge by, without the ones that lie off. False if there was none to test.
bool AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& complete,
                        const std::vector<Reading>& readings,
                        DiagnosisResult* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
