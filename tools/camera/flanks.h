// Flanks of lines in rows of pixels, to parts of a pixel.
#ifndef DHCAL_TOOLS_CAMERA_FLANKS_H_
#define DHCAL_TOOLS_CAMERA_FLANKS_H_

#include <vector>

#include <opencv2/core.hpp>

namespace dhcal {

/// The two flanks of a line in one row.
struct FlankPair {
  double first = 0, second = 0;  // [px]
  double height = 0;             // of the lower flank, in an arbitrary unit
  double middle() const { return 0.5 * (first + second); }
};

struct FlankRow {
  int row = 0;
  std::vector<FlankPair> pairs;  // from left to right; may be empty
};

struct FlankRows {
  std::vector<FlankRow> rows;
  double slope = 0;  // of the lines, px along the row for each row
};

/// Lines of a grey image (CV_32F), which run down or aslant by less than 45 deg; `dark` ones or
/// bright ones. `rows` is empty where no flank stands out.
FlankRows FindFlanks(const cv::Mat& gray, bool dark);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_FLANKS_H_
