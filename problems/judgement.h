// What a result says of itself as a whole.
#ifndef DHCAL_PROBLEMS_JUDGEMENT_H_
#define DHCAL_PROBLEMS_JUDGEMENT_H_

#include "core/model/result.h"

namespace dhcal {

/// True if the best fit leaves less than any instrument reads (kFinestSigma).
bool IsNoiseFree(const Result& result);

/// Whether the best fit's intervals hold: by the diagnosis where there is one that came to an
/// answer, else by the fit's chi-square. To be asked again when a diagnosis has been added.
IntervalVerdict JudgeIntervals(const Result& result);

/// The same for geometry and effects fitted together.
IntervalVerdict JudgeDelivered(const DiagnosisResult& diagnosis);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_JUDGEMENT_H_
