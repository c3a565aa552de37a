#include "core/io/folder_swap.h"

#include <cerrno>
#include <optional>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/posix_file.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

constexpr char kPartial[] = ".partial";  // not in place yet, or just replaced
constexpr char kOld[] = ".old";          // moved aside by kRenameTwice

/// ".<folder>.<machine>.": hidden, beside the folder, so that renaming stays in one file system.
std::string SiblingPrefix(const fs::path& folder) {
  return fmt::format(".{}.{}.", folder.filename().string(), HostName());
}

fs::path Sibling(const fs::path& folder, const std::string& ending) {
  return folder.parent_path() / fmt::format("{}{}{}", SiblingPrefix(folder), ::getpid(), ending);
}

/// Deletes a folder of ours; false when something that is not ours keeps it alive.
bool RemoveOwn(const fs::path& folder, const std::vector<std::string>& own_names) {
  std::error_code error;
  for (const std::string& name : own_names) fs::remove(folder / name, error);
  fs::remove(folder, error);  // only when empty
  return !error;
}

/// True for ".<folder>.<machine>.<process>.<ending>" of a process that is no more.
bool IsLeftover(const std::string& name, const std::string& prefix, const std::string& ending) {
  if (!StartsWith(name, prefix) || !EndsWith(name, ending)) return false;
  if (name.size() <= prefix.size() + ending.size()) return false;
  const std::size_t length = name.size() - prefix.size() - ending.size();
  const std::optional<std::int64_t> process = ParseInteger(name.substr(prefix.size(), length));
  return process && *process > 0 && IsGoneOrSelf(static_cast<int>(*process));
}

std::vector<fs::path> Leftovers(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> found;
  const std::string prefix = SiblingPrefix(folder);
  std::error_code error;
  for (fs::directory_iterator entry(folder.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (IsLeftover(entry->path().filename().string(), prefix, ending)) {
      found.push_back(entry->path());
    }
  }
  return found;
}

void CleanLeftovers(const fs::path& folder, const std::vector<std::string>& own_names) {
  for (const fs::path& old : Leftovers(folder, kOld)) {
    std::error_code error;
    if (!fs::exists(folder, error) && RenameEntry(old, folder) == 0) continue;
    RemoveOwn(old, own_names);
  }
  for (const fs::path& partial : Leftovers(folder, kPartial)) RemoveOwn(partial, own_names);
}

bool Fail(const fs::path& where, const std::string& what, int error, Diagnostics* diagnostics) {
  diagnostics->Error({where.string()}, fmt::format("{}: {}", what, ErrorText(error)));
  return false;
}

bool WriteFiles(const fs::path& folder,
                const std::vector<NamedContent>& files,
                Diagnostics* diagnostics) {
  std::error_code made;
  if (!fs::create_directory(folder, made)) {
    return Fail(folder, "the folder cannot be made", made ? made.value() : EEXIST, diagnostics);
  }
  for (const NamedContent& file : files) {
    const int error = WriteDurably(folder / file.name, file.content);
    if (error != 0) return Fail(folder / file.name, "cannot be written", error, diagnostics);
  }
  const int error = SyncFolder(folder);
  return error == 0 || Fail(folder, "cannot be written", error, diagnostics);
}

/// Afterwards the old folder, if there was one, has the returned path.
int PutInPlace(const fs::path& partial, const fs::path& folder, SwapMethod method, fs::path* old) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored) || fs::is_empty(folder, ignored)) {
    return RenameEntry(partial, folder);
  }
  *old = partial;
  const int error = method == SwapMethod::kExchange ? ExchangeEntries(partial, folder) : ENOSYS;
  if (error != EINVAL && error != ENOSYS && error != ENOTSUP) return error;
  *old = Sibling(folder, kOld);
  const int aside = RenameEntry(folder, *old);
  if (aside != 0) return aside;
  const int in = RenameEntry(partial, folder);
  if (in != 0) RenameEntry(*old, folder);
  return in;
}

}  // namespace

bool ReplaceFolder(const fs::path& folder,
                   const std::vector<NamedContent>& files,
                   const std::vector<std::string>& own_names,
                   SwapMethod method,
                   Diagnostics* diagnostics) {
  const fs::path parent = folder.parent_path();
  std::error_code made;
  fs::create_directories(parent, made);
  if (made) return Fail(parent, "the folder cannot be made", made.value(), diagnostics);
  CleanLeftovers(folder, own_names);
  const fs::path partial = Sibling(folder, kPartial);
  if (!WriteFiles(partial, files, diagnostics)) {
    RemoveOwn(partial, own_names);
    return false;
  }
  fs::path old;
  const int error = PutInPlace(partial, folder, method, &old);
  if (error != 0) {
    RemoveOwn(partial, own_names);
    return Fail(folder, "cannot be put in place", error, diagnostics);
  }
  SyncFolder(parent);
  if (!old.empty() && !RemoveOwn(old, own_names)) {
    diagnostics->Warning({old.string()},
                         "what stood in the result folder before could not be "
                         "deleted completely and remains here");
  }
  return true;
}

}  // namespace dhcal
