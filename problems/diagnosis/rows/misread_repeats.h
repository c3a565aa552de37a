// Repeats of a pose that say something else than the others: their median hides them from the
// search, and they would spoil a fit of all rows.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MISREAD_REPEATS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MISREAD_REPEATS_H_

#include <vector>

#include "core/model/recording.h"
#include "problems/diagnosis/rows/repeats.h"

namespace dhcal {

/// Rows of `recorded` whose lengths are far from the median of their pose's, as measured by how far
/// all repeats are from theirs. Of one or two readings none says which is wrong.
std::vector<int> MisreadRepeats(const Recording& recorded, const DistinctRows& distinct);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ROWS_MISREAD_REPEATS_H_
