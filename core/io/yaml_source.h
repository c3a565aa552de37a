// The text of a YAML file: parses it, finds places in it, and collects its errors.
#ifndef DHCAL_CORE_IO_YAML_SOURCE_H_
#define DHCAL_CORE_IO_YAML_SOURCE_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "core/base/diagnostics.h"

namespace dhcal {

/// A file being read: places in it, and where its errors go. Outlives its values.
class YamlSource {
 public:
  YamlSource(std::string file, std::string content, Diagnostics* diagnostics);

  const std::string& file() const { return file_; }

  /// The file as one YAML document, or nothing after an error.
  std::optional<YAML::Node> Parse() const;

  void Error(const SourceLocation& where, const std::string& message) const;
  void Warning(const SourceLocation& where, const std::string& message) const;
  /// Messages about another file that this one names.
  void AddAll(const Diagnostics& others) const;
  /// Errors so far.
  int num_errors() const { return diagnostics_->num_errors(); }

  /// Line and column, counted from 1 and in characters.
  SourceLocation At(const YAML::Mark& mark) const;

 private:
  std::string_view Line(int line_idx) const;
  bool HoldsOneDocument() const;
  void ReportSyntax(const YAML::Exception& error) const;

  std::string file_;
  std::string content_;
  Diagnostics* diagnostics_;
  std::vector<std::size_t> line_starts_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_YAML_SOURCE_H_
