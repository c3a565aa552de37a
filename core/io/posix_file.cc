#include "core/io/posix_file.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace dhcal {
namespace {

class FileDescriptor {
 public:
  FileDescriptor(const std::filesystem::path& path, int flags)
      : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { Close(); }

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  /// Some file systems report a failed write only here.
  int Close() {
    if (!is_open()) return 0;
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int descriptor_;
};

int WriteAll(int descriptor, const std::string& content) {
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + written, content.size() - written);
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  return 0;
}

}  // namespace

std::string ErrorText(int error) { return std::generic_category().message(error); }

int WriteDurably(const std::filesystem::path& file, const std::string& content) {
  FileDescriptor descriptor(file, O_WRONLY | O_CREAT | O_EXCL);
  if (!descriptor.is_open()) return errno;
  const int error = WriteAll(descriptor.get(), content);
  if (error != 0) return error;
  if (::fsync(descriptor.get()) != 0) return errno;
  return descriptor.Close();
}

int SyncFolder(const std::filesystem::path& folder) {
  const FileDescriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (!descriptor.is_open()) return errno;
  // EINVAL: a file system that keeps its folders on the disk anyway.
  return ::fsync(descriptor.get()) == 0 || errno == EINVAL ? 0 : errno;
}

int ExchangeEntries(const std::filesystem::path& a, const std::filesystem::path& b) {
  const int result = ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE);
  return result == 0 ? 0 : errno;
}

int RenameEntry(const std::filesystem::path& from, const std::filesystem::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

std::string HostName() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

bool IsGoneOrSelf(int process_id) {
  return process_id == ::getpid() || (::kill(process_id, 0) != 0 && errno == ESRCH);
}

}  // namespace dhcal
