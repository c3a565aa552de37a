// Files of a case as the program reads them.
#ifndef DHCAL_TESTS_TOOLS_PROOF_SIMULATOR_READ_BACK_H_
#define DHCAL_TESTS_TOOLS_PROOF_SIMULATOR_READ_BACK_H_

#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/temp_folder.h"
#include "tools/proof/simulator/case_files.h"

namespace dhcal {

struct ReadCase {
  std::optional<ProblemSpec> spec;
  std::optional<Recording> recording;
  Diagnostics diagnostics;
};

/// Recording only where the problem file could be read.
inline ReadCase ReadBack(const concealed::CaseFiles& files) {
  const TempFolder folder;
  WriteFile(folder / "problem.yaml", files.problem);
  WriteFile(folder / "recording.csv", files.recording);
  ReadCase read;
  read.spec = ReadProblemFile(folder / "problem.yaml", "", &read.diagnostics);
  if (read.spec) {
    read.recording =
        ReadRecording(folder / "recording.csv", read.spec->robot.joints, &read.diagnostics);
  }
  return read;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_TOOLS_PROOF_SIMULATOR_READ_BACK_H_
