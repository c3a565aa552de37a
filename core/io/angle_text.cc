#include "core/io/angle_text.h"

#include <string>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {

std::optional<double> ParsePi(std::string_view text) {
  constexpr std::string_view kRad = "rad";
  if (EndsWith(text, kRad)) text.remove_suffix(kRad.size());
  std::string compact;
  for (const char c : text) {
    if (c != ' ' && c != '\t') compact += c;
  }
  const std::size_t pi = compact.find("pi");
  if (pi == std::string::npos) return std::nullopt;
  std::string factor = compact.substr(0, pi);
  const std::string rest = compact.substr(pi + 2);
  if (EndsWith(factor, "*")) {
    factor.pop_back();
    if (factor.empty() || factor == "-" || factor == "+") return std::nullopt;
  }
  if (factor.empty() || factor == "-" || factor == "+") factor += "1";
  std::optional<double> number = ParseDouble(factor);
  if (!number) return std::nullopt;
  double radians = *number * kPi;
  if (rest.empty()) return radians;
  number = ParseDouble(rest.substr(1));
  if (!number || *number == 0) return std::nullopt;
  if (rest[0] == '/') return radians / *number;
  if (rest[0] == '*') return radians * *number;
  return std::nullopt;
}

}  // namespace dhcal
