#include "core/io/yaml_source.h"

#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include "core/base/text.h"

namespace dhcal {

namespace {

/// Notes where documents start, and whether nothing but a null was in them.
class DocumentStarts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;
  bool only_null = true;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnScalar(const YAML::Mark& /*mark*/,
                const std::string& /*tag*/,
                YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    only_null = false;
  }
  void OnSequenceStart(const YAML::Mark& /*mark*/,
                       const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {
    only_null = false;
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/,
                  const std::string& /*tag*/,
                  YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    only_null = false;
  }
  void OnMapEnd() override {}
};

}  // namespace

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

void YamlSource::AddAll(const Diagnostics& others) const {
  for (const Diagnostic& other : others.all()) diagnostics_->Add(other);
}

std::optional<YAML::Node> YamlSource::Parse() const {
  try {
    if (!HoldsOneDocument()) return std::nullopt;
    return YAML::Load(content_);
  } catch (const YAML::DeepRecursion&) {
    Error({file_, 1, 1}, "the file is not a problem: it is nested too deeply");
  } catch (const YAML::Exception& error) {
    ReportSyntax(error);
  }
  return std::nullopt;
}

bool YamlSource::HoldsOneDocument() const {
  // Not YAML::LoadAll, which never ends on a comma that stands outside all brackets.
  std::istringstream stream(content_);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) {
  }
  if (starts.marks.empty() || (starts.marks.size() == 1 && starts.only_null)) {
    Error({file_, 1, 1}, "the file holds no keys; start with 'schema: 1'");
    return false;
  }
  if (starts.marks.size() == 1) return true;
  const SourceLocation second = At(starts.marks[1]);
  if (StartsWith(Line(starts.marks[1].line), "---")) {
    Error(second, "a second YAML document starts here; one problem per file");
  } else {
    Error(second, "this is not valid YAML: it does not continue what stands before it");
  }
  return false;
}

void YamlSource::ReportSyntax(const YAML::Exception& error) const {
  const std::string_view line = Line(error.mark.line);
  const std::string_view indent = line.substr(0, line.find_first_not_of(" \t"));
  const std::size_t tab = indent.find('\t');
  if (tab != std::string_view::npos) {
    Error({file_, error.mark.line + 1, static_cast<int>(tab) + 1},
          "the line is indented with a tab; YAML wants blanks");
    return;
  }
  Error(At(error.mark),
        fmt::format("this is not valid YAML ({}); check indentation, colons, quotes and brackets "
                    "here and in the lines before",
                    error.msg));
}

}  // namespace dhcal
