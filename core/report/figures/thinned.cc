#include "core/report/figures/thinned.h"

#include <string>

#include <fmt/format.h>

namespace dhcal {

std::string Thinned::Words(const std::string& what) const {
  if (step <= 1) return "";
  const std::size_t tens = step / 10 % 10, ones = step % 10;
  const char* const ending = tens == 1   ? "th"
                             : ones == 1 ? "st"
                             : ones == 2 ? "nd"
                             : ones == 3 ? "rd"
                                         : "th";
  return fmt::format(" Drawn is every {}{} {} of {}.", step, ending, what, count);
}

}  // namespace dhcal
