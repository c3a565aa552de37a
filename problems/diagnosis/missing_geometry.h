// Geometric freedoms that the problem file holds fixed although the readings ask for them: named
// as geometry before anything is called physics (physics.md X1).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_

#include "core/model/diagnosis.h"
#include "core/model/result.h"
#include "problems/diagnosis/complete_fit.h"

namespace dhcal {

/// Tests axis_tilt, base_frame and tool_offset, as far as the file leaves them out, at the file's
/// own fit; adds a finding for each that is needed, with its size from the complete fit.
void AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& complete,
                        DiagnosisResult* diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_MISSING_GEOMETRY_H_
