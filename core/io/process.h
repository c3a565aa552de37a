// Runs another program for what it prints.
#ifndef DHCAL_CORE_IO_PROCESS_H_
#define DHCAL_CORE_IO_PROCESS_H_

#include <chrono>
#include <string>
#include <vector>

namespace dhcal {

struct ProcessOutput {
  enum class End { kNotFound, kFailed, kTimeOut, kDone };
  End end = End::kFailed;
  std::string text;  // all that it printed to its standard output; only with kDone
};

/// Runs `words` (the program, looked up on PATH, and its arguments) with `input` as its standard
/// input, in the C locale, its error messages dropped. Ends it after `patience`. kDone where it
/// ended with status 0. Throws nothing: what the system refuses is kFailed.
ProcessOutput RunForOutput(std::vector<std::string> words,
                           const std::string& input,
                           std::chrono::milliseconds patience);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_PROCESS_H_
