#include "core/io/yaml_source.h"

#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>

#include "core/base/text.h"

namespace dhcal {

YamlSource::YamlSource(std::string file, std::string content, Diagnostics* diagnostics)
    : file_(std::move(file)), content_(std::move(content)), diagnostics_(diagnostics) {
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < content_.size(); ++i) {
    if (content_[i] == '\n') line_starts_.push_back(i + 1);
  }
}

std::string_view YamlSource::Line(int line_idx) const {
  if (line_idx < 0 || line_idx >= static_cast<int>(line_starts_.size())) return {};
  const std::string_view rest = std::string_view(content_).substr(line_starts_[line_idx]);
  return rest.substr(0, rest.find('\n'));
}

SourceLocation YamlSource::At(const YAML::Mark& mark) const {
  if (mark.is_null()) return {file_};
  // The library counts bytes.
  const std::string_view line = Line(mark.line);
  const std::string_view before = line.substr(0, static_cast<std::size_t>(mark.column));
  return {file_, mark.line + 1, CountCharacters(before) + 1};
}

void YamlSource::Error(const SourceLocation& where, const std::string& message) const {
  diagnostics_->Error(where, message);
}

void YamlSource::Warning(const SourceLocation& where, const std::string& message) const {
  diagnostics_->Warning(where, message);
}

std::optional<YAML::Node> YamlSource::Parse() const {
  const auto fail = [&](const SourceLocation& where, const std::string& message) {
    Error(where, message);
    return std::nullopt;
  };
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(content_);
    if (documents.empty() || documents[0].IsNull()) {
      return fail({file_, 1, 1}, "the file holds no keys; start with 'schema: 1'");
    }
    if (documents.size() > 1) {
      return fail(At(documents[1].Mark()),
                  "a second YAML document starts here; one problem per file");
    }
    return documents[0];
  } catch (const YAML::DeepRecursion&) {
    return fail({file_, 1, 1}, "the file is not a problem: it is nested too deeply");
  } catch (const YAML::Exception& error) {
    const std::string_view line = Line(error.mark.line);
    const std::string_view indent = line.substr(0, line.find_first_not_of(" \t"));
    const std::size_t tab = indent.find('\t');
    if (tab != std::string_view::npos) {
      return fail({file_, error.mark.line + 1, static_cast<int>(tab) + 1},
                  "the line is indented with a tab; YAML wants blanks");
    }
    return fail(At(error.mark),
                fmt::format("this is not valid YAML ({}); check indentation, colons, quotes and "
                            "brackets here and in the lines before",
                            error.msg));
  }
}

}  // namespace dhcal
