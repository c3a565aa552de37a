// The table of the other readings, row by row beside the images, and the recording that both make.
#ifndef DHCAL_TOOLS_CAMERA_READINGS_H_
#define DHCAL_TOOLS_CAMERA_READINGS_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/io/cell_table.h"

namespace dhcal {

struct Readings {
  CellTable table;
  int coarse = -1, image = -1;           // columns; -1 = not there
  std::vector<int> heights;              // height1_mm, height2_mm
  std::vector<double> coarse_positions;  // [mm], of each row; empty without the column
  std::vector<int> groups;               // of each row: run and edge
};

/// Reads a table with as many rows as there are images. The column `coarse_mm` (or `ruler_mm`) is
/// where the camera roughly is; `image`, where it is there, must name the images in their order.
std::optional<Readings> ReadReadings(const std::string& file,
                                     const std::vector<std::string>& images,
                                     Diagnostics* diagnostics);

/// Whether it can become a recording: with joint coordinates, heights, and edges.
void CheckReadings(const Readings& readings, const std::string& file, Diagnostics* diagnostics);

/// The table without `coarse_mm` and `image`, with `ruler_mm` [mm]. Where that is NaN the row has
/// neither it nor heights: a head reads all three or nothing.
std::string RecordingText(const Readings& readings, const std::vector<double>& ruler);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_READINGS_H_
