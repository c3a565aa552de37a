// Anonymous items: any smooth function of one driver at one place, and products of two joint
// angles. They compete with the names, so that a name is given only where it beats them.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_CELLS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_CELLS_H_

#include <vector>

#include "core/physics/context.h"
#include "problems/diagnosis/hypotheses/item.h"

namespace dhcal {

/// A joint's error against its own angle is the name transmission_error, and no cell.
std::vector<Item> CellItems(const PhysicsContext& context);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_CELLS_H_
