// A file for one test.
#ifndef DHCAL_TESTS_SUPPORT_TEMP_FILE_H_
#define DHCAL_TESTS_SUPPORT_TEMP_FILE_H_

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

#include <gtest/gtest.h>

namespace dhcal {

/// Written at the start, removed at the end. Tests run side by side, so the name holds the process.
class TempFile {
 public:
  explicit TempFile(std::string_view content, const std::string& ending = ".txt")
      : path_(testing::TempDir() + "dhcal_" + std::to_string(getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ending) {
    // Of a parameterised test the name holds a slash.
    std::replace(
        path_.begin() + static_cast<long>(testing::TempDir().size()), path_.end(), '/', '_');
    std::ofstream stream(path_, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  ~TempFile() { std::remove(path_.c_str()); }
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_TEMP_FILE_H_
