#include "problems/formats/problem/problem_checks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "problems/formats/problem/effect_checks.h"
#include "problems/formats/problem/parameter_names.h"
#include "residuals/registry.h"

namespace dhcal {

namespace {

using Names = std::vector<std::string>;

bool Contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The checks, one method each.
class FitChecker {
 public:
  FitChecker(const ProblemSpec& spec, const Recording& recording, Diagnostics* diagnostics)
      : spec_(spec), recording_(recording), diagnostics_(diagnostics) {}

  void CheckColumns();
  void CheckTargets();
  void CheckAnchors();
  void CheckEdges();
  void CheckRuns();
  void CheckSets();

 private:
  SourceLocation AtFile() const { return {recording_.file}; }
  SourceLocation AtRow(int row_idx) const;
  void Error(const SourceLocation& where, const std::string& message);
  /// Names in the data against names in the problem file, both ways.
  void CompareNames(const std::string& what,
                    const Names& used,
                    const std::vector<int>& idx_of_row,
                    const Names& defined);
  void CheckRunFrames(const std::string& frame, const std::vector<RunFrame>& frames);

  const ProblemSpec& spec_;
  const Recording& recording_;
  Diagnostics* diagnostics_;
};

SourceLocation FitChecker::AtRow(int row_idx) const {
  if (recording_.lines.empty()) return AtFile();
  return {recording_.file, recording_.lines[row_idx]};
}

void FitChecker::Error(const SourceLocation& where, const std::string& message) {
  diagnostics_->Error(where, message);
}

void FitChecker::CheckColumns() {
  const std::string missing = MakeMeasurement(spec_.measurement, recording_)->Missing();
  if (!missing.empty()) return Error(AtFile(), missing);
  if (!spec_.measurement.anchored) return;
  const bool known = recording_.p_WQ.rows() > 0 && recording_.p_WQ.row(0).allFinite();
  if (!known) {
    Error(AtFile(),
          "'measurement.anchored: first' needs the position of the first row in x_mm, y_mm, z_mm "
          "(or _m); add it or remove the key");
  }
}

void FitChecker::CompareNames(const std::string& what,
                              const Names& used,
                              const std::vector<int>& idx_of_row,
                              const Names& defined) {
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (Contains(defined, used[i])) continue;
    const auto first = std::find(idx_of_row.begin(), idx_of_row.end(), static_cast<int>(i));
    const std::string nearest = NearestName(used[i], defined);
    Error(AtRow(static_cast<int>(first - idx_of_row.begin())),
          fmt::format("the {0} '{1}' is not defined in the problem file{2}; define it under '{0}s'",
                      what,
                      Printable(used[i]),
                      nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
  }
  for (const std::string& name : defined) {
    if (Contains(used, name)) continue;
    diagnostics_->Warning(
        AtFile(), fmt::format("no row has the {} '{}' of the problem file", what, Printable(name)));
  }
}

void FitChecker::CheckTargets() {
  Names defined;
  for (const Target& target : spec_.robot.targets) defined.push_back(target.name);
  const bool has_column = !recording_.target_idx.empty();
  if (defined.size() > 1 && !has_column) {
    Error(AtFile(),
          fmt::format("the problem file has the targets {}, but the recording has no column "
                      "'target' that says which one a row measured",
                      QuotedList(defined, "and")));
    return;
  }
  if (defined.empty() && recording_.target_names.size() == 1) {
    diagnostics_->Warning(AtFile(),
                          fmt::format("every row measured the target '{}'; the problem file has no "
                                      "'targets', so its 'tool' stands for it",
                                      Printable(recording_.target_names[0])));
    return;
  }
  if (has_column) {
    CompareNames("target", recording_.target_names, recording_.target_idx, defined);
  }
}

void FitChecker::CheckAnchors() {
  if (!spec_.measurement.kind.anchors) return;
  if (recording_.anchor_idx.empty() || recording_.distance.rows() == 0) return;
  Names defined;
  for (const Anchor& anchor : spec_.measurement.anchors) defined.push_back(anchor.name);
  CompareNames("anchor", recording_.anchor_names, recording_.anchor_idx, defined);
  for (int row = 0; row < recording_.num_rows(); ++row) {
    if (std::isnan(recording_.distance[row]) || recording_.anchor_idx[row] >= 0) continue;
    Error(AtRow(row), "the row has a distance, but its cell 'anchor' is blank; name the anchor");
    return;
  }
}

void FitChecker::CheckEdges() {
  if (!spec_.measurement.kind.edges) return;
  if (recording_.edge_idx.empty() || recording_.head.rows() == 0) return;
  if (!spec_.robot.edges.empty()) {
    Names defined;
    for (const Edge& edge : spec_.robot.edges) defined.push_back(edge.name);
    CompareNames("edge", recording_.edge_names, recording_.edge_idx, defined);
  }
  for (int row = 0; row < recording_.num_rows(); ++row) {
    if (std::isnan(recording_.head(row, 0)) || recording_.edge_idx[row] >= 0) continue;
    Error(AtRow(row), "the row has a ruler reading, but its cell 'edge' is blank; name the edge");
    return;
  }
}

void FitChecker::CheckRunFrames(const std::string& frame, const std::vector<RunFrame>& frames) {
  for (const RunFrame& run_frame : frames) {
    if (Contains(recording_.run_names, run_frame.run)) continue;
    const std::string nearest = NearestName(run_frame.run, recording_.run_names);
    Error({spec_.file},
          fmt::format("'robot.{}.runs.{}': the recording has no run of this name{}",
                      frame,
                      Printable(run_frame.run),
                      nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }
}

void FitChecker::CheckRuns() {
  CheckRunFrames("base", spec_.robot.base_of_run);
  CheckRunFrames("tool", spec_.robot.tool_of_run);
  Names owners = recording_.run_names;
  owners.insert(owners.end(), recording_.edge_names.begin(), recording_.edge_names.end());
  for (const Target& target : spec_.robot.targets) owners.push_back(target.name);
  Names names = spec_.parameters.estimate;
  names.insert(names.end(), spec_.parameters.fix.begin(), spec_.parameters.fix.end());
  for (const auto& [name, sigma] : spec_.parameters.prior_sigma) names.push_back(name);
  for (const std::string& name : names) {
    const std::string owner = SplitOwner(name).second;
    if (owner.empty() || Contains(owners, owner)) continue;
    const char* const kind = spec_.robot.base_per_edge ? "edge" : "run";
    Error(spec_.parameters.where,
          fmt::format("the parameter '{}' is one of the {} '{}', but the recording has no {} of "
                      "this name",
                      Printable(name),
                      kind,
                      Printable(owner),
                      kind));
  }
}

void FitChecker::CheckSets() {
  const std::vector<bool>& is_test = recording_.is_test;
  if (is_test.empty() || std::find(is_test.begin(), is_test.end(), false) != is_test.end()) return;
  Error(AtFile(), "all rows are of the set 'test', so none is left to fit; mark some 'train'");
}

}  // namespace

bool CheckRecordingExists(const ProblemSpec& spec, Diagnostics* diagnostics) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::path file = spec.recording;
  if (spec.recording.empty() || fs::exists(file, status)) return true;
  const fs::path whole = fs::absolute(file, status).lexically_normal();
  fs::path folder = whole.parent_path();
  std::string missing = whole.filename().string();
  while (!fs::is_directory(folder, status) && folder.has_relative_path()) {
    missing = folder.filename().string();
    folder = folder.parent_path();
  }
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
    names.push_back(entry.path().filename().string());
  }
  const std::string nearest = NearestName(missing, names);
  diagnostics->Error(
      spec.recording_where,
      fmt::format("the recording '{}' is not there: {} has no '{}'{}",
                  Printable(spec.recording),
                  Printable(folder.string()),
                  Printable(missing),
                  nearest.empty() ? std::string("; check the path, which is relative to the "
                                                "problem file")
                                  : "; did you mean '" + Printable(nearest) + "'?"));
  return false;
}

void CheckRecordingFits(const ProblemSpec& spec,
                        const Recording& recording,
                        Diagnostics* diagnostics) {
  FitChecker checker(spec, recording, diagnostics);
  checker.CheckColumns();
  checker.CheckTargets();
  checker.CheckAnchors();
  checker.CheckEdges();
  checker.CheckRuns();
  checker.CheckSets();
  CheckEffectsFit(spec, recording, diagnostics);
}

}  // namespace dhcal
