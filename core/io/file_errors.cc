#include "core/io/file_errors.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace dhcal {

void FileErrors::Error(const SourceLocation& where, const std::string& message) {
  // Cut now and then, so that a wholly wrong large file does not fill the memory.
  constexpr std::size_t kCutAt = 1000;
  errors_.push_back({Severity::kError, where, message});
  ++num_errors_;
  if (errors_.size() >= kCutAt) SortAndCut();
}

void FileErrors::Warning(const SourceLocation& where, const std::string& message) {
  remarks_.push_back({Severity::kWarning, where, message});
}

void FileErrors::Note(const SourceLocation& where, const std::string& message) {
  remarks_.push_back({Severity::kNote, where, message});
}

void FileErrors::SortAndCut() {
  std::stable_sort(errors_.begin(), errors_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  if (errors_.size() > kMaxReported) errors_.resize(kMaxReported);
}

void FileErrors::Report(Diagnostics* diagnostics) {
  SortAndCut();
  for (const Diagnostic& remark : remarks_) diagnostics->Add(remark);
  for (const Diagnostic& error : errors_) diagnostics->Add(error);
  const std::size_t more = num_errors_ - errors_.size();
  if (more > 0) diagnostics->Error({file_}, fmt::format("... and {} more errors", more));
}

}  // namespace dhcal
