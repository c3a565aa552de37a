// Angles written with pi, as tables of robots have them.
#ifndef DHCAL_CORE_IO_ANGLE_TEXT_H_
#define DHCAL_CORE_IO_ANGLE_TEXT_H_

#include <optional>
#include <string_view>

namespace dhcal {

/// The number [rad] of "pi", "-pi/2", "3*pi/4", "3pi/4", "pi/2 rad", or nothing when `text` holds
/// no pi or something else beside it.
std::optional<double> ParsePi(std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_ANGLE_TEXT_H_
