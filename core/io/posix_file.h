// The few file operations of the operating system that the standard library does not offer.
// Functions return 0 or an errno value.
#ifndef DHCAL_CORE_IO_POSIX_FILE_H_
#define DHCAL_CORE_IO_POSIX_FILE_H_

#include <filesystem>
#include <string>

namespace dhcal {

/// "Permission denied".
std::string ErrorText(int error);

/// Creates a file that must not exist, and returns when its content is on the disk.
int WriteDurably(const std::filesystem::path& file, const std::string& content);

/// Returns when the folder's entries are on the disk.
int SyncFolder(const std::filesystem::path& folder);

/// Swaps two existing entries in one step.
int ExchangeEntries(const std::filesystem::path& a, const std::filesystem::path& b);

/// Renames in one step; an empty folder at `to` is replaced, one with files is an error.
int RenameEntry(const std::filesystem::path& from, const std::filesystem::path& to);

/// This machine's name.
std::string HostName();

/// True when no process of this machine has the number, or it is this process itself.
bool IsGoneOrSelf(int process_id);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_POSIX_FILE_H_
