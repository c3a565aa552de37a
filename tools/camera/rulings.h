// What one photograph of the ruled edge says: where its centre is along the rulings.
#ifndef DHCAL_TOOLS_CAMERA_RULINGS_H_
#define DHCAL_TOOLS_CAMERA_RULINGS_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "tools/camera/lens.h"
#include "tools/camera/pencil.h"
#include "tools/camera/tracks.h"

namespace dhcal {

struct RulerOptions {
  TrackOptions view;
  bool backwards = false;  // the ruler counts to the left or up
  int longest_gap = 3;     // rulings missing side by side that are still counted across
  int fewest = 6;          // rulings that a reading takes
};

/// A ruling as it was found, before any model smoothed it.
struct FoundRuling {
  int number = 0;
  Eigen::Vector2d place;   // on its middle line, near the middle of what is seen of it [px]
  double error_px = 0;     // median of its pieces' distances from the model, along the ruler
  bool set_aside = false;  // lies off the row of the others
};

struct RulerReading {
  std::string refusal;                // why there is none; "" = a reading
  std::vector<NumberedPiece> pieces;  // that the fit holds to
  std::vector<FoundRuling> rulings;
  Pencil pencil;
  double place = 0;         // x of the lens' centre, in pitches; where it counts from is arbitrary
  double sigma = 0;         // of it [pitches]
  double error_px = 0;      // robust scatter of the pieces [px]
  double px_per_pitch = 0;  // at the centre
  double width = 0;         // of the lines, in pitches
  int missing = 0;          // rulings between the first and the last that were not found
  int num_set_aside = 0;
};

/// Pieces numbered by counting from line to line alone, which a lens may bend as it likes.
struct CountedRulings {
  std::string refusal;
  std::vector<Track> tracks;
  std::vector<std::vector<NumberedPiece>> counts;  // the likeliest first; several where in doubt
};

/// Rulings that have a piece.
int NumRulings(const std::vector<NumberedPiece>& pieces);

CountedRulings CountRulings(const cv::Mat& gray, const Lens& lens, const RulerOptions& options);

/// The row of rulings as a whole, from what was counted. A count is refused where the row, seen by
/// a camera, does not bear it out: lines that fall between rulings, other numbers than counted,
/// gaps that could be one ruling longer or shorter, two counts that both make an even row.
RulerReading FitRulings(const CountedRulings& counted,
                        const Lens& lens,
                        const RulerOptions& options);

/// Both.
RulerReading ReadRulings(const cv::Mat& gray, const Lens& lens, const RulerOptions& options);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_RULINGS_H_
