// Which ruling is which: whole numbers for the lines of an image, counted along the ruler.
#ifndef DHCAL_TOOLS_CAMERA_NUMBERING_H_
#define DHCAL_TOOLS_CAMERA_NUMBERING_H_

#include <optional>
#include <string>
#include <vector>

#include "tools/camera/lens.h"
#include "tools/camera/tracks.h"

namespace dhcal {

/// A line across the ruler: one track or several that lie on one line.
struct CandidateLine {
  double place = 0;   // where it crosses the reference line along the ruler [px], lens undone
  double weight = 0;  // 1 for one as long as most
  std::vector<int> tracks;
};

/// Lines from long tracks, in the order of their places.
std::vector<CandidateLine> CandidateLines(const std::vector<Track>& tracks,
                                          const Lens& lens,
                                          bool along_columns);

/// The numbers of candidate lines; absent for what fits no number.
struct Numbering {
  std::vector<std::optional<int>> numbers;  // of the lines
  double score = 0;  // weight that fits, less what does not and what is missing
  double pitch = 0;  // [px] between rulings in the middle
  int found = 0;
};

/// Numberings that begin with two neighbours as one pitch and step on from there, the pitch
/// changing little from step to step: the best, and those that count otherwise and score nearly as
/// much, at most four. None where no three lines follow each other.
std::vector<Numbering> NumberLines(const std::vector<CandidateLine>& lines, int longest_gap);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_NUMBERING_H_
