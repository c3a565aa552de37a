#include "core/report/format.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {
namespace {

/// Exponent of ten of the first of `digits` significant digits, after rounding to them.
int ExponentOf(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::string exponent = text.substr(text.find('e') + 1);
  return static_cast<int>(*ParseInteger(exponent));
}

}  // namespace

std::string Fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  if (!(std::abs(value) < 1e7)) return fmt::format("{:.3e}", value);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  if (zero && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string FixedWithin(double value, int decimals, int width) {
  for (int fewer = decimals; fewer >= 0; --fewer) {
    std::string text = Fixed(value, fewer);
    if (static_cast<int>(text.size()) <= width) return text;
  }
  return Scientific(value, std::max(0, width - 8));
}

std::string Scientific(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}e}", value, decimals);
}

std::string Millimetres(double metres) {
  constexpr int kDigits = 4;
  constexpr double kSmallest = 1e-4;  // [mm] nobody measures less
  const double mm = metres / kMillimetre;
  if (mm == 0) return "0";
  if (std::abs(mm) < kSmallest) return "<0.0001";
  if (!std::isfinite(mm) || std::abs(mm) >= 1e7) return Fixed(mm, 0);
  return Fixed(mm, std::max(0, kDigits - 1 - ExponentOf(mm, kDigits)));
}

std::string WithMillimetres(double metres) {
  return std::isnan(metres) ? "not known" : Millimetres(metres) + " mm";
}

int DecimalsOf(double sigma, int otherwise) {
  if (!std::isfinite(sigma) || sigma <= 0) return otherwise;
  return std::max(0, 1 - ExponentOf(sigma, 2));
}

std::string AndMore(std::size_t count) {
  return fmt::format("... and {} more in result.json", count);
}

std::string Counted(int count, const std::string& singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

}  // namespace dhcal
