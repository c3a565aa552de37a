// The readings that remain when rows of a recording are set aside.
#ifndef DHCAL_PROBLEMS_WITHOUT_ROWS_H_
#define DHCAL_PROBLEMS_WITHOUT_ROWS_H_

#include <set>
#include <vector>

#include "core/model/reading.h"
#include "problems/calibration.h"

namespace dhcal {

/// Readings without those of some rows of the recording. Of differences between shared poses that
/// were read as positions, one leads over the gap.
std::vector<Reading> WithoutRows(const Calibration& calibration,
                                 const std::vector<Reading>& readings,
                                 const std::set<int>& rows);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_WITHOUT_ROWS_H_
