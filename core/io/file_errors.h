// Errors of one file, sorted by place and cut off: one mistake in a column makes thousands.
#ifndef DHCAL_CORE_IO_FILE_ERRORS_H_
#define DHCAL_CORE_IO_FILE_ERRORS_H_

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"

namespace dhcal {

class FileErrors {
 public:
  static constexpr std::size_t kMaxReported = 20;

  explicit FileErrors(std::string file) : file_(std::move(file)) {}

  void Error(const SourceLocation& where, const std::string& message);
  void Warning(const SourceLocation& where, const std::string& message);
  void Note(const SourceLocation& where, const std::string& message);

  bool ok() const { return num_errors_ == 0; }
  const std::string& file() const { return file_; }

  /// Hands over the notes and warnings, the first kMaxReported errors and the number of the rest.
  void Report(Diagnostics* diagnostics);

 private:
  void SortAndCut();

  std::string file_;
  std::vector<Diagnostic> errors_;
  std::vector<Diagnostic> remarks_;  // notes and warnings
  std::size_t num_errors_ = 0;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_FILE_ERRORS_H_
