// Readings that are the controller's own positions: computed from the table, not measured.
#ifndef DHCAL_PROBLEMS_SETUP_OWN_POSITION_H_
#define DHCAL_PROBLEMS_SETUP_OWN_POSITION_H_

#include <optional>

#include "problems/setup/cause.h"

namespace dhcal {

/// A cause where the nominal robot, with base and tool fitted, meets the readings as closely as the
/// digits of the files allow and its errors cannot be seen at all, as with no real robot. `misfit`
/// [m]: by how much it misses them, RMS.
std::optional<SetupCause> OwnPosition(const Files& files, double misfit);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_OWN_POSITION_H_
