// A lens calibrated by photographs of the ruler alone: of all lenses the one under which each
// image's rulings are an even row of straight lines, seen by a camera (after Ofner, cited by
// English et al. 2004: the transformation that straightens image lines). Nothing need be known of
// pitch, poses or focal length.
#ifndef DHCAL_TOOLS_CAMERA_STRAIGHTEN_H_
#define DHCAL_TOOLS_CAMERA_STRAIGHTEN_H_

#include <string>
#include <vector>

#include "tools/camera/lens.h"
#include "tools/camera/pencil.h"

namespace dhcal {

struct StraightenedLens {
  Lens lens;
  double rms_before = 0, rms_after = 0;  // of the pieces' errors [px], robust
  int images = 0;
  std::string failure;  // "" = there is a lens
};

/// `rows`: numbered pieces of each image. Pencils of all images and the lens in one fit (Ceres),
/// under Tukey's loss; covariance from the fit with the scatter found, pieces of one ruling taken
/// to err alike.
StraightenedLens Straighten(const Lens& start, std::vector<std::vector<NumberedPiece>> rows);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_STRAIGHTEN_H_
