#include "core/base/diagnostics.h"

namespace dhcal {

std::string SourceLocation::ToString() const {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

std::string Diagnostic::ToString() const {
  const std::string place = where.ToString();
  const char* const kind = severity == Severity::kError ? "error: " : "warning: ";
  return (place.empty() ? "" : place + ": ") + kind + message;
}

void Diagnostics::Error(SourceLocation where, std::string message) {
  all_.push_back({Severity::kError, std::move(where), std::move(message)});
  ++num_errors_;
}

void Diagnostics::Warning(SourceLocation where, std::string message) {
  all_.push_back({Severity::kWarning, std::move(where), std::move(message)});
}

std::string Diagnostics::ToString() const {
  std::string text;
  for (const Diagnostic& diagnostic : all_) text += diagnostic.ToString() + "\n";
  return text;
}

}  // namespace dhcal
