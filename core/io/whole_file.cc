#include "core/io/whole_file.h"

#include <filesystem>
#include <system_error>

#include "core/io/posix_file.h"

namespace dhcal {

bool WriteWholeFile(const std::string& file, const std::string& text, Diagnostics* diagnostics) {
  namespace fs = std::filesystem;
  const fs::path path(file);
  std::error_code status;
  if (fs::is_directory(path, status)) {
    diagnostics->Error({file}, "is a folder, but the name of a file is expected");
    return false;
  }
  const fs::path aside(file + ".partial");
  fs::remove(aside, status);
  int error = WriteDurably(aside, text);
  if (error == 0) error = RenameEntry(aside, path);
  if (error == 0) return true;
  fs::remove(aside, status);
  diagnostics->Error({file}, "cannot be written: " + ErrorText(error));
  return false;
}

}  // namespace dhcal
