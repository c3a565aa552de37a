#include "tools/camera/count.h"

#include <cmath>
#include <cstddef>
#include <map>

#include <fmt/format.h>

#include "core/math/statistics.h"

namespace dhcal {
namespace {

// A ruler that is seen from another height or aslant changes its scale, but not by half.
constexpr double kLeastScale = 0.6, kLargestScale = 1.6;

struct Before {
  double place = 0, coarse = 0;
};

}  // namespace

std::vector<CountedPlace> CountAlong(const std::vector<ImagePlace>& images, double tolerance) {
  std::vector<double> scales;
  for (const ImagePlace& image : images) {
    if (image.readable) scales.push_back(image.scale);
  }
  const double usual = Median(scales);
  std::vector<CountedPlace> counted(images.size());
  std::map<int, Before> before;  // the last image of each group
  for (std::size_t k = 0; k < images.size(); ++k) {
    const ImagePlace& image = images[k];
    if (!image.readable) continue;
    const double scale = image.scale / usual;
    if (scale < kLeastScale || scale > kLargestScale) {
      counted[k].doubt = fmt::format(
          "has its rulings {:.1f} px apart, the images in the middle {:.1f} "
          "px: a count of every other ruling, or another ruler",
          image.scale,
          usual);
      continue;
    }
    const auto last = before.find(image.group);
    const bool is_first = last == before.end();
    const double expected =
        is_first ? image.coarse : last->second.place + image.coarse - last->second.coarse;
    const double place = image.place + std::round(expected - image.place);
    if (!is_first && std::abs(place - expected) > tolerance) {
      counted[k].doubt = fmt::format(
          "shows rulings {:.2f} pitches beside where the coarse position expects them from the "
          "image "
          "before, and more than {:.2f} could be another ruling (wrong pitch, direction or coarse "
          "position?)",
          std::abs(place - expected),
          tolerance);
      continue;
    }
    counted[k].place = place;
    before[image.group] = {place, image.coarse};
  }
  return counted;
}

}  // namespace dhcal
