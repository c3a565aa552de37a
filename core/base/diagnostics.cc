#include "core/base/diagnostics.h"

namespace dhcal {

namespace {

const char* Word(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note: ";
    case Severity::kWarning:
      return "warning: ";
    case Severity::kError:
      break;
  }
  return "error: ";
}

}  // namespace

std::string SourceLocation::ToString() const {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

std::string Diagnostic::ToString() const {
  const std::string place = where.ToString();
  return (place.empty() ? "" : place + ": ") + Word(severity) + message;
}

void Diagnostics::Add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::kError) ++num_errors_;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::Error(SourceLocation where, std::string message) {
  Add({Severity::kError, std::move(where), std::move(message)});
}

void Diagnostics::Warning(SourceLocation where, std::string message) {
  Add({Severity::kWarning, std::move(where), std::move(message)});
}

void Diagnostics::Note(SourceLocation where, std::string message) {
  Add({Severity::kNote, std::move(where), std::move(message)});
}

std::string Diagnostics::ToString() const {
  std::string text;
  for (const Diagnostic& diagnostic : all_) text += diagnostic.ToString() + "\n";
  return text;
}

}  // namespace dhcal
