// All named things that a recording may show, in all the forms in which they are tried.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LIBRARY_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LIBRARY_H_

#include <string>
#include <vector>

#include "core/model/effect_request.h"
#include "core/physics/context.h"
#include "problems/diagnosis/hypotheses/item.h"

namespace dhcal {

struct LibraryOptions {
  std::vector<std::string> names;       // that may be given; empty = all
  std::vector<EffectRequest> switched;  // on in the problem file: not tried
  int num_poses = 0;                    // that differ
  bool masses_given = true;
  bool coarse = false;  // few instants: for a first model
  /// Members of a model: forms of them with settings close by are tried, too.
  std::vector<EffectRequest> near;
  /// Slots of cells that go by the clock among them: there a step may be between any two rows.
  std::vector<std::string> clocked;
};

/// Items of the library's effects. Forms: every pair of joints for a coupling, instants and time
/// constants on a grid, whole orders, knot distances of a curve.
std::vector<Item> NamedItems(const PhysicsContext& context, const LibraryOptions& options);

/// The item of one request; `variants`: forms that it was chosen from.
Item NamedItem(const PhysicsContext& context, const EffectRequest& request, int variants);

/// Instants between rows, up to so many rows before and after one.
std::vector<double> InstantsAround(const PhysicsContext& context, double instant, int rows);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LIBRARY_H_
