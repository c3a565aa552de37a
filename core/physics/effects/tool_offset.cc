// Missing freedom of the geometry: the tool frame that the file holds fixed.
//
//   tool_xyz += (x, y, z) [m],  tool_rxyz += (rx, ry, rz) [rad]
//
// Left out, it looks like physics. Typical: 0.1-10 mm. Source: physics.md X1, D19. Geometry, not
// physics: named first.
// Worked number: z = 2 mm adds 2 mm to tool_z in every row.
#include "core/physics/frame_effect.h"

namespace dhcal {

const Effect& ToolOffset() {
  static const FrameEffect effect(
      "tool_offset",
      ParameterGroup::kTool,
      "the measured point lies elsewhere on the flange than the file says");
  return effect;
}

}  // namespace dhcal
