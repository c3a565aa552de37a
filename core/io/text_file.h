// Reads a text file whole, and says in plain words when it is none.
#ifndef DHCAL_CORE_IO_TEXT_FILE_H_
#define DHCAL_CORE_IO_TEXT_FILE_H_

#include <optional>
#include <string>

#include "core/base/diagnostics.h"

namespace dhcal {

/// The file's content as UTF-8 without its byte order mark; UTF-16 with one is converted, and
/// `*utf16` says so. Adds an error and returns nothing when the file is missing, a folder,
/// unreadable, empty, binary or neither UTF-8 nor UTF-16.
std::optional<std::string> ReadTextFile(const std::string& file,
                                        Diagnostics* diagnostics,
                                        bool* utf16 = nullptr);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_TEXT_FILE_H_
