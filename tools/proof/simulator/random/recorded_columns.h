// Columns that somebody recorded beside the readings, of quantities that the program does not know.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RECORDED_COLUMNS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RECORDED_COLUMNS_H_

#include <vector>

#include "core/base/rng.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// None, or one to three: temperatures that follow a room or a motor, pressures and loads that
/// differ from row to row. What is read of them has noise and few digits.
std::vector<RecordedColumn> DrawColumns(const RandomTrial& trial, Rng* rng);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RECORDED_COLUMNS_H_
