// The command line of dhcal_ruler as numbers.
#ifndef DHCAL_TOOLS_CAMERA_SETTINGS_H_
#define DHCAL_TOOLS_CAMERA_SETTINGS_H_

#include "core/base/diagnostics.h"
#include "tools/camera/rulings.h"
#include "tools/camera/run.h"

namespace dhcal {

struct RulerSettings {
  RulerOptions ruler;
  double pitch = 0;         // [mm]
  double coarse_error = 0;  // [mm], of a move between images
  double step = 0;          // [mm] from image to image; 0 = not given
  int threads = 1;
};

/// Errors say which flag is wrong, and what is expected.
RulerSettings ReadSettings(const RulerCommand& command, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_SETTINGS_H_
