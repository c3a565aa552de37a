// A lens from the images of a run.
#ifndef DHCAL_TOOLS_CAMERA_CALIBRATE_LENS_H_
#define DHCAL_TOOLS_CAMERA_CALIBRATE_LENS_H_

#include <vector>

#include "tools/camera/rulings.h"
#include "tools/camera/straighten.h"

namespace dhcal {

/// Straightens what was counted in the images; then, with that lens at hand, counts by whole rows,
/// leaves out what is off them, and straightens again.
StraightenedLens CalibrateLens(const Lens& plain,
                               const std::vector<CountedRulings>& counted,
                               const RulerOptions& options);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_CALIBRATE_LENS_H_
