// Text in lines of a fixed width.
#ifndef DHCAL_CORE_REPORT_TEXT_LAYOUT_H_
#define DHCAL_CORE_REPORT_TEXT_LAYOUT_H_

#include <string>
#include <string_view>

namespace dhcal {

constexpr int kReportWidth = 100;  // [characters]
constexpr int kTextIndent = 2;     // [characters] of all that stands below a heading

/// "" for a count below 1.
std::string Spaces(int count);

/// At most `width` characters; a longer text loses its middle.
std::string Clip(std::string_view text, int width);

/// Lines of at most kReportWidth: the first starts with `first`, the others are indented as far.
/// Ends with a line break.
std::string Wrap(const std::string& first, std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_TEXT_LAYOUT_H_
