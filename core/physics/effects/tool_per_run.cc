// Missing freedom of the geometry: the tool of each run.
//
//   tool_xyz of a run += (x, y, z) [m],  tool_rxyz += (rx, ry, rz) [rad]; the first run has none
//
// The tool was mounted anew between them. Left out, it looks like steps, drifts and payloads.
// Typical: 0.1-10 mm. Source: PHYSICS.md X1. Geometry, not physics. Worked number: z_2 = 2 mm adds
// 2 mm to tool_z in every row of run 2.
#include "core/physics/run_frame_effect.h"

namespace dhcal {

const Effect& ToolPerRun() {
  static const RunFrameEffect effect("tool_per_run", "tool");
  return effect;
}

}  // namespace dhcal
