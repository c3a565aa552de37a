// Missing freedom of the geometry: the base frame that the file holds fixed.
//
//   base_xyz += (x, y, z) [m],  base_rxyz += (rx, ry, rz) [rad]
//
// Left out, it looks like physics. Typical: 0.1-10 mm. Source: physics.md X1, D19. Geometry, not
// physics: named first.
// Worked number: z = 2 mm adds 2 mm to base_z in every row.
#include "core/physics/frame_effect.h"

namespace dhcal {

const Effect& BaseFrame() {
  static const FrameEffect effect(
      "base_frame", ParameterGroup::kBase, "the base stands elsewhere than the file says");
  return effect;
}

}  // namespace dhcal
