// Writes one file so that a reader sees the old or the new one, never a part.
#ifndef DHCAL_CORE_IO_WHOLE_FILE_H_
#define DHCAL_CORE_IO_WHOLE_FILE_H_

#include <string>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Written beside `file` and renamed. False, with an error added and `file` as it was, where that
/// cannot be done.
bool WriteWholeFile(const std::string& file, const std::string& text, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_WHOLE_FILE_H_
