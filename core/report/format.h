// Numbers and sentences of the text report. Nothing here depends on the locale.
#ifndef DHCAL_CORE_REPORT_FORMAT_H_
#define DHCAL_CORE_REPORT_FORMAT_H_

#include <string>
#include <string_view>

namespace dhcal {

constexpr int kReportWidth = 100;  // [characters]

/// Fixed decimals, "-" for NaN, never "-0.00"; scientific from 1e7 on.
std::string Fixed(double value, int decimals);

/// The same, with fewer decimals or scientific where that is needed to fit `width`.
std::string FixedWithin(double value, int decimals, int width);

/// "1.23e-05", "-" for NaN.
std::string Scientific(double value, int decimals);

/// Four significant digits in millimetres without the unit; scientific below 1e-4 mm.
std::string Millimetres(double metres);

/// "0.02130 mm", or "not known" for NaN.
std::string WithMillimetres(double metres);

/// How many decimals show two significant digits of `sigma`; `otherwise` when it is not a
/// positive number.
int DecimalsOf(double sigma, int otherwise);

/// At most `width` characters; a longer text loses its middle.
std::string Clip(std::string_view text, int width);

/// Lines of at most kReportWidth: the first starts with `first`, the others are indented as far.
/// Ends with a line break.
std::string Wrap(const std::string& first, std::string_view text);

/// A heading of a section, with the empty line before it.
std::string Heading(const std::string& title);

/// "... and 12 more in result.json".
std::string AndMore(std::size_t count);

/// "1 row", "2 rows".
std::string Counted(int count, const std::string& singular);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_FORMAT_H_
