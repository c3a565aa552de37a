// Missing freedom of the geometry: the base of each run.
//
//   base_xyz of a run += (x, y, z) [m],  base_rxyz += (rx, ry, rz) [rad]; the first run has none
//
// The instrument or the base was set up anew between them. Left out, it looks like steps, drifts
// and payloads. Typical: 0.1-10 mm. Source: PHYSICS.md X1. Geometry, not physics. Worked number:
// z_2 = 2 mm adds 2 mm to base_z in every row of run 2.
#include "core/physics/run_frame_effect.h"

namespace dhcal {

const Effect& BasePerRun() {
  static const RunFrameEffect effect("base_per_run", "base");
  return effect;
}

}  // namespace dhcal
