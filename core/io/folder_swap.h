// Replaces a folder as a whole: a reader, or a kill at any moment, sees the old or the new one.
#ifndef DHCAL_CORE_IO_FOLDER_SWAP_H_
#define DHCAL_CORE_IO_FOLDER_SWAP_H_

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace dhcal {

struct NamedContent {
  std::string name;
  std::string content;
};

enum class SwapMethod {
  kExchange,     // one step; falls back to the other where the file system has no such step
  kRenameTwice,  // a kill between the two leaves the old folder beside; the next call brings it
                 // back
};

/// Writes `files` to a folder beside `folder`, puts it in the place of `folder` and deletes what
/// was there: the files named in `own_names`, never another one. Missing parents are made. What an
/// earlier call left beside because its process was killed is cleaned first. `folder` is an
/// absolute path without a trailing slash. Returns false after adding an error.
bool ReplaceFolder(const std::filesystem::path& folder,
                   const std::vector<NamedContent>& files,
                   const std::vector<std::string>& own_names,
                   SwapMethod method,
                   Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_FOLDER_SWAP_H_
