// What casts doubt on a count of rulings. Each returns why the image is refused, "" where it is
// not.
#ifndef DHCAL_TOOLS_CAMERA_ROW_CHECKS_H_
#define DHCAL_TOOLS_CAMERA_ROW_CHECKS_H_

#include <string>
#include <vector>

#include "tools/camera/lens.h"
#include "tools/camera/pencil.h"
#include "tools/camera/rulings.h"
#include "tools/camera/tracks.h"

namespace dhcal {

/// Whether the row as a whole bears out the numbers that came from counting line by line.
std::string CountDoubt(const Pencil& pencil,
                       const Lens& lens,
                       const std::vector<NumberedPiece>& counted);

/// Whether a reading may be taken from the row: enough rulings, no wide or doubtful gap, few lines
/// between them, the centre among them, a useful sigma.
std::string RowDoubt(const RulerReading& reading,
                     const Lens& lens,
                     const std::vector<Track>& tracks,
                     const RulerOptions& options);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CAMERA_ROW_CHECKS_H_
