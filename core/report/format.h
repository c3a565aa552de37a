// Numbers in the words of a report. Nothing here depends on the locale.
#ifndef DHCAL_CORE_REPORT_FORMAT_H_
#define DHCAL_CORE_REPORT_FORMAT_H_

#include <string>

namespace dhcal {

/// Fixed decimals, "-" for NaN, never "-0.00"; scientific from 1e7 on.
std::string Fixed(double value, int decimals);

/// The same, with fewer decimals or scientific where that is needed to fit `width`.
std::string FixedWithin(double value, int decimals, int width);

/// "1.23e-05", "-" for NaN.
std::string Scientific(double value, int decimals);

/// Four significant digits in millimetres without the unit; "<0.0001" below that.
std::string Millimetres(double metres);

/// "0.02130 mm", or "not known" for NaN.
std::string WithMillimetres(double metres);

/// How many decimals show two significant digits of `sigma`; `otherwise` when it is not a
/// positive number.
int DecimalsOf(double sigma, int otherwise);

/// "... and 12 more in result.json".
std::string AndMore(std::size_t count);

/// "1 row", "2 rows".
std::string Counted(int count, const std::string& singular);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_FORMAT_H_
