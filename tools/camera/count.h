// Which ruling it is, from image to image. An image tells where its centre is between two rulings;
// how many whole pitches lie between two images, a coarse position must tell.
#ifndef DHCAL_TOOLS_CAMERA_COUNT_H_
#define DHCAL_TOOLS_CAMERA_COUNT_H_

#include <limits>
#include <string>
#include <vector>

namespace dhcal {

struct ImagePlace {
  bool readable = false;
  double place = 0;   // of the centre, in pitches, from an arbitrary ruling
  double scale = 0;   // [px / pitch]
  double coarse = 0;  // where the camera roughly is [pitches]
  int group = 0;      // run and edge; nothing is counted from one to another
};

struct CountedPlace {
  double place = std::numeric_limits<double>::quiet_NaN();  // [pitches]; NaN where there is none
  std::string doubt;                                        // why a readable image has none
};

/// Places along the ruler, each counted from the readable image before it in its group by how far
/// the coarse positions say that the camera moved; the first is the one nearest to its coarse
/// position. A move that lies more than `tolerance` (below 0.5) pitches beside the coarse one is in
/// doubt, and so is an image whose scale is far from that of the others.
std::vector<CountedPlace> CountAlong(const std::vector<ImagePlace>& images, double tolerance);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_COUNT_H_
