// ceres_dhcal: identifies the real geometry of serial robots from recordings.

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/base/quiet_log.h"
#include "tools/support/batch.h"
#include "tools/support/command_line.h"
#include "tools/support/import_run.h"
#include "tools/support/init_run.h"

namespace {

/// Matrices of a hundred megabytes come and go: memory once asked for is kept, for the system takes
/// longer to hand out and clear a page than the program to fill it.
void KeepMemory() {
#ifdef __GLIBC__
  constexpr int kGigabyte = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kGigabyte);
  mallopt(M_TRIM_THRESHOLD, kGigabyte);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  KeepMemory();
  dhcal::StartQuietLog(argv[0]);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "init") {
    return dhcal::RunInit({words.begin() + 1, words.end()});
  }
  dhcal::CommandLine command_line;
  switch (dhcal::ParseCommandLine(argc, argv, &command_line)) {
    case dhcal::CommandLineStatus::kDone:
      return dhcal::kExitOk;
    case dhcal::CommandLineStatus::kError:
      return dhcal::kExitBadInput;
    case dhcal::CommandLineStatus::kRun:
      break;
  }
  try {
    return command_line.import.empty() ? dhcal::RunBatch(command_line)
                                       : dhcal::RunImport(command_line);
  } catch (const std::exception& error) {
    std::cerr << "ceres_dhcal: internal error: " << error.what() << "\n";
    return dhcal::kExitNoUsableResult;
  }
}
