#include "core/base/flag_values.h"

#include <optional>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {

void FlagValues::Whole(const char* name, const std::string& text, int low, int high, int* number) {
  double value = 0;
  if (!Number(name, text, low, high, &value)) return;
  if (value != static_cast<int>(value)) {
    return Wrong(name, text, "a whole number");
  }
  *number = static_cast<int>(value);
}

bool FlagValues::Number(
    const char* name, const std::string& text, double low, double high, double* number) {
  if (text.empty()) return false;
  const std::optional<double> value = ParseDouble(text);
  if (value && *value >= low && *value <= high) {
    *number = *value;
    return true;
  }
  Wrong(name, text, fmt::format("a number from {:g} to {:g}", low, high));
  return false;
}

void FlagValues::Wrong(const char* name, const std::string& text, const std::string& expected) {
  Error(fmt::format("--{} is '{}', but {} is expected", name, Printable(text), expected));
}

}  // namespace dhcal
