// Readings that were paired rightly up to some row, and a row or two beside from there on.
#ifndef DHCAL_PROBLEMS_SETUP_SHIFTED_PART_H_
#define DHCAL_PROBLEMS_SETUP_SHIFTED_PART_H_

#include <optional>
#include <vector>

#include "core/model/reading.h"
#include "problems/setup/search.h"

namespace dhcal {

/// `piece`: readings, at the beginning or end of a run, that fit under `candidate`. The set-up
/// under which the run's other readings fit as well, with a shift from some row on; nothing where
/// there is none.
std::optional<SetUp> ShiftedPart(const Files& files,
                                 const Candidate& candidate,
                                 const std::vector<Reading>& piece);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_SHIFTED_PART_H_
