#include "problems/formats/recording/recording_reader.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/cell_table.h"
#include "core/io/file_errors.h"
#include "problems/formats/recording/column_spelling.h"
#include "problems/formats/recording/recording_cells.h"
#include "problems/formats/recording/recording_layout.h"
#include "problems/formats/recording/recording_orientation.h"

namespace dhcal {

namespace {

/// Names of the columns that the format does not have, as the warning about them lists them.
struct UnknownColumns {
  std::string kept, with_blanks, of_text;
};

/// Fills a Recording field by field from the columns found.
class RecordingFiller {
 public:
  RecordingFiller(const CellTable& table,
                  const RecordingLayout& layout,
                  int num_joints,
                  FileErrors* errors)
      : table_(table),
        layout_(layout),
        num_joints_(num_joints),
        errors_(errors),
        cells_(table, errors) {}

  Recording Fill();

 private:
  Eigen::MatrixXd Numbers(RecordingField field, const NumberRule& rule = kAnyNumber);
  Eigen::VectorXd Number(RecordingField field, const NumberRule& rule = kAnyNumber);
  /// Coordinates of which a row has all or none.
  Eigen::MatrixXd Coordinates(RecordingField field);
  /// The field's columns as the file names them.
  std::vector<std::string> Names(RecordingField field) const;
  Eigen::MatrixXd Joints();
  /// Nothing where the clock stands: then it is none.
  Eigen::VectorXd Time();
  std::vector<int> Labels(RecordingField field, bool may_be_blank, std::vector<std::string>* names);
  std::vector<bool> TestRows();
  std::vector<ExtraColumn> Extra();
  void WarnOfUnknown(const UnknownColumns& unknown);

  const CellTable& table_;
  const RecordingLayout& layout_;
  int num_joints_;
  FileErrors* errors_;
  CellReader cells_;
};

Eigen::MatrixXd RecordingFiller::Numbers(RecordingField field, const NumberRule& rule) {
  if (!layout_.Has(field)) return {};
  return cells_.ReadNumbers(layout_.fields.at(field), rule);
}

Eigen::VectorXd RecordingFiller::Number(RecordingField field, const NumberRule& rule) {
  if (!layout_.Has(field)) return {};
  return Numbers(field, rule).col(0);
}

Eigen::MatrixXd RecordingFiller::Coordinates(RecordingField field) {
  if (!layout_.Has(field)) return {};
  return cells_.ReadCoordinates(layout_.fields.at(field));
}

std::vector<std::string> RecordingFiller::Names(RecordingField field) const {
  std::vector<std::string> names;
  if (!layout_.Has(field)) return names;
  for (const int column : layout_.fields.at(field).column) {
    if (column >= 0) names.emplace_back(table_.name(column));
  }
  return names;
}

Eigen::MatrixXd RecordingFiller::Joints() {
  if (!layout_.Has(RecordingField::kJoint)) {
    return Eigen::MatrixXd::Constant(
        table_.num_rows(), num_joints_, std::numeric_limits<double>::quiet_NaN());
  }
  for (const int column : layout_.fields.at(RecordingField::kJoint).column) {
    if (column >= 0) cells_.CheckNoneBlank(column);
  }
  return Numbers(RecordingField::kJoint);
}

Eigen::VectorXd RecordingFiller::Time() {
  Eigen::VectorXd time = Number(RecordingField::kTime);
  const bool stands = time.size() > 1 && (time.array() == time[0]).all();
  if (!stands) return time;
  const int column = layout_.Column(RecordingField::kTime);
  errors_->Warning(table_.NameWhere(column),
                   fmt::format("column '{}' holds the same time in all rows, and is not used",
                               Printable(table_.name(column))));
  return {};
}

std::vector<int> RecordingFiller::Labels(RecordingField field,
                                         bool may_be_blank,
                                         std::vector<std::string>* names) {
  if (!layout_.Has(field)) return {};
  return cells_.ReadLabels(layout_.Column(field), may_be_blank, names);
}

std::vector<bool> RecordingFiller::TestRows() {
  if (!layout_.Has(RecordingField::kSet)) return {};
  const int column = layout_.Column(RecordingField::kSet);
  std::vector<bool> is_test(table_.num_rows(), false);
  for (int row = 0; row < table_.num_rows(); ++row) {
    const std::string_view cell = table_.cell(row, column);
    is_test[row] = cell == "test";
    if (cell == "test" || cell == "train" || cell.empty()) continue;
    cells_.Error(row, column, fmt::format("'{}' must be 'train' or 'test'", Printable(cell)));
  }
  return is_test;
}

void RecordingFiller::WarnOfUnknown(const UnknownColumns& unknown) {
  std::string message;
  for (const auto& [what, names] :
       {std::pair("unknown columns, kept as possible drivers: ", &unknown.kept),
        std::pair("unknown columns, ignored because of blank cells: ", &unknown.with_blanks),
        std::pair("columns of text, ignored: ", &unknown.of_text)}) {
    if (names->empty()) continue;
    message += (message.empty() ? "" : "; ") + (what + *names);
  }
  if (!message.empty()) errors_->Warning(table_.NameWhere(0), message);
}

std::vector<ExtraColumn> RecordingFiller::Extra() {
  std::vector<ExtraColumn> extra;
  UnknownColumns unknown;
  for (std::size_t i = 0; i < layout_.unknown.size(); ++i) {
    const int column = layout_.unknown[i];
    const std::string name(table_.name(column));
    const bool numeric = cells_.IsNumeric(column);
    const std::optional<int> blank = cells_.FirstBlankLine(column);
    // With blanks it drives nothing, but a copy of the recording still has it.
    if (numeric) extra.push_back({name, cells_.NumbersOrNaN(column)});
    std::string* const list = !numeric ? &unknown.of_text
                              : blank  ? &unknown.with_blanks
                                       : &unknown.kept;
    *list += (list->empty() ? "'" : ", '") + Printable(name) + "'";
    if (numeric && blank) *list += fmt::format(" (first in line {})", *blank);
    if (!layout_.hints[i].empty()) *list += " (did you mean '" + layout_.hints[i] + "'?)";
  }
  WarnOfUnknown(unknown);
  return extra;
}

Recording RecordingFiller::Fill() {
  Recording recording;
  for (int row = 0; row < table_.num_rows(); ++row) recording.lines.push_back(table_.line(row));
  recording.header_line = table_.NameWhere(0).line;
  recording.q_names = Names(RecordingField::kJoint);
  recording.p_names = Names(RecordingField::kPosition);
  recording.q = Joints();
  recording.p_WQ = Coordinates(RecordingField::kPosition);
  recording.displacement = Coordinates(RecordingField::kDisplacement);
  recording.quaternion = ReadOrientations(layout_, cells_);
  recording.distance = Number(RecordingField::kDistance, kPositive);
  recording.head = Coordinates(RecordingField::kHead);
  recording.sigma = Number(RecordingField::kSigma, kPositive);
  recording.time = Time();
  recording.payload = Number(RecordingField::kPayload, kNotNegative);
  recording.temperature =
      Numbers(layout_.Has(RecordingField::kTemperature) ? RecordingField::kTemperature
                                                        : RecordingField::kJointTemperature);
  recording.direction = Numbers(RecordingField::kDirection, kSign);
  recording.speed = Numbers(RecordingField::kSpeed);
  recording.torque = Numbers(RecordingField::kTorque);
  recording.run_idx = Labels(RecordingField::kRun, false, &recording.run_names);
  recording.target_idx = Labels(RecordingField::kTarget, false, &recording.target_names);
  recording.anchor_idx = Labels(RecordingField::kAnchor, true, &recording.anchor_names);
  recording.edge_idx = Labels(RecordingField::kEdge, true, &recording.edge_names);
  recording.is_test = TestRows();
  recording.extra = Extra();
  return recording;
}

std::optional<Recording> Read(const std::string& file,
                              const std::vector<JointRow>& joints,
                              const std::vector<ColumnAlias>& columns,
                              JointsIn joints_in,
                              Diagnostics* diagnostics) {
  FileErrors errors(file);
  std::optional<Recording> recording;
  if (const std::optional<CellTable> table = ReadTable(file, &errors, IsUnitWord)) {
    const RecordingLayout layout = FindColumns(*table, joints, columns, &errors, joints_in);
    recording = RecordingFiller(*table, layout, static_cast<int>(joints.size()), &errors).Fill();
    recording->file = file;
  }
  errors.Report(diagnostics);
  return errors.ok() ? std::move(recording) : std::nullopt;
}

}  // namespace

std::optional<Recording> ReadRecording(const std::string& file,
                                       const std::vector<JointRow>& joints,
                                       const std::vector<ColumnAlias>& columns,
                                       Diagnostics* diagnostics) {
  return Read(file, joints, columns, JointsIn::kAllTables, diagnostics);
}

std::optional<Recording> ReadRecording(const std::string& file,
                                       const std::vector<JointRow>& joints,
                                       Diagnostics* diagnostics) {
  return ReadRecording(file, joints, {}, diagnostics);
}

std::optional<Recording> ReadPoses(const std::string& file,
                                   const std::vector<JointRow>& joints,
                                   Diagnostics* diagnostics) {
  return Read(file, joints, {}, JointsIn::kSomeTables, diagnostics);
}

}  // namespace dhcal
