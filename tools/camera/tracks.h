// Rulings as they are seen in an image: the two flanks of each, row by row.
#ifndef DHCAL_TOOLS_CAMERA_TRACKS_H_
#define DHCAL_TOOLS_CAMERA_TRACKS_H_

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace dhcal {

/// What may be seen of a ruling over a few rows of pixels: a line fitted to its flanks, at the
/// middle of these rows.
struct RulingPiece {
  Eigen::Vector2d first, second;  // its flanks, the one of lower coordinate first [px]
  double sigma = 0;  // of its middle along the ruler, from the scatter about the line [px]
  int track_idx = 0;
};

/// Flanks that follow each other from row to row: a ruling, a part of one, or something else.
struct Track {
  int rows = 0;  // that it was seen in
  std::vector<RulingPiece> pieces;
};

struct TrackOptions {
  bool along_columns = false;  // the ruler runs down the image, not across it
  bool dark = true;            // the rulings are the dark lines
};

/// All tracks of at least a dozen rows. A flank is where brightness, divided by that of the
/// neighbourhood, changes fastest along the row: the peak of a Gaussian's derivative, interpolated
/// in its logarithm. Blur, the width of the lines and the curve of the camera's response move both
/// flanks of a line apart by as much, and leave its middle.
std::vector<Track> FindTracks(const cv::Mat& gray, const TrackOptions& options);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_TRACKS_H_
