// What a page holds, for tests of the report in HTML.
#ifndef DHCAL_TESTS_SUPPORT_PAGES_H_
#define DHCAL_TESTS_SUPPORT_PAGES_H_

#include <chrono>
#include <regex>
#include <string>
#include <vector>

#include "core/io/process.h"

namespace dhcal {

/// True where this machine has the program.
inline bool HasProgram(const std::string& name) {
  const auto seconds = std::chrono::seconds(20);
  return RunForOutput({name, "--version"}, "", seconds).end == ProcessOutput::End::kDone;
}

/// First groups of all matches.
inline std::vector<std::string> MatchesIn(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

inline std::size_t CountOf(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_PAGES_H_
