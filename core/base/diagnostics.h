// Messages about a user's input, collected so that all of them can be shown at once.
#ifndef DHCAL_CORE_BASE_DIAGNOSTICS_H_
#define DHCAL_CORE_BASE_DIAGNOSTICS_H_

#include <string>
#include <utility>
#include <vector>

namespace dhcal {

/// A place in an input file. Lines and columns count from 1; 0 = unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;

  /// "file:line:column", without the parts that are unknown.
  std::string ToString() const;
};

/// A note says what was understood how; nothing is wrong.
enum class Severity { kNote, kWarning, kError };

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceLocation where;
  std::string message;

  /// "file:line:column: error: message".
  std::string ToString() const;
};

/// Collects errors, warnings and notes; the caller decides when to stop.
class Diagnostics {
 public:
  void Error(SourceLocation where, std::string message);
  void Warning(SourceLocation where, std::string message);
  void Note(SourceLocation where, std::string message);
  void Add(Diagnostic diagnostic);

  bool ok() const { return num_errors_ == 0; }
  int num_errors() const { return num_errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// One line per message, in the order found.
  std::string ToString() const;

 private:
  std::vector<Diagnostic> all_;
  int num_errors_ = 0;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_DIAGNOSTICS_H_
