// dhcal_simulate: writes the recording that a problem file's `simulate` describes, of any kind of
// measurement.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/base/quiet_log.h"
#include "core/io/whole_file.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/simulate.h"

namespace dhcal {
namespace {

constexpr int kOk = 0, kBadInput = 2;

constexpr char kHelp[] =
    R"(dhcal_simulate: writes the recording that the key 'simulate' of a problem file describes.

  dhcal_simulate PROBLEM.yaml RECORDING.csv

The recording is written in SI units, as a whole or not at all. DHCAL_DATA names the folder that
${DHCAL_DATA} in the problem file stands for.

Exit status: 0 written, 2 bad input.
)";

int Simulate(const std::string& problem, const std::string& file) {
  Diagnostics diagnostics;
  const char* const data = std::getenv("DHCAL_DATA");
  const std::optional<ProblemSpec> spec =
      ReadProblemFile(problem, data == nullptr ? "" : data, &diagnostics);
  if (spec && !spec->simulate) {
    diagnostics.Error({problem}, "the file has no key 'simulate', so there is nothing to simulate");
  } else if (spec) {
    const std::optional<Recording> recording = SimulateRecording(*spec, &diagnostics);
    if (recording && diagnostics.ok()) {
      WriteWholeFile(file, RecordingToCsv(*recording, spec->robot), &diagnostics);
    }
  }
  std::cerr << diagnostics.ToString();
  return diagnostics.ok() ? kOk : kBadInput;
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::cout << dhcal::kHelp;
    return dhcal::kOk;
  }
  if (argc != 3 || argv[1][0] == '-') {
    std::cerr << "usage: dhcal_simulate PROBLEM.yaml RECORDING.csv; see --help\n";
    return dhcal::kBadInput;
  }
  try {
    return dhcal::Simulate(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "dhcal_simulate: internal error: " << error.what() << "\n";
    return dhcal::kBadInput;
  }
}
