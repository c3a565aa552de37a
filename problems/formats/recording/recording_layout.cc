#include "problems/formats/recording/recording_layout.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {

namespace {

/// The search behind FindColumns.
class ColumnFinder {
 public:
  ColumnFinder(const CsvTable& table, const std::vector<JointRow>& joints, FileErrors* errors)
      : table_(table),
        num_joints_(static_cast<int>(joints.size())),
        known_(KnownColumns(joints)),
        errors_(errors) {}

  RecordingLayout Find();

 private:
  void Place(int column_idx);
  void PlaceKnown(int column_idx, const KnownColumn& known);
  void PlaceUnknown(int column_idx, const std::string& name);
  void FindHints();
  FieldColumns* Field(RecordingField field);
  void CheckComplete(RecordingField field);
  void CheckJoints();
  /// The spellings of one component: "'q3_deg' or 'q3_rad'".
  std::string SpellingsOf(RecordingField field, int component) const;
  std::string NearestUnknown(const std::string& name) const;
  /// A place for what the header lacks.
  SourceLocation HeaderWhere() const { return table_.NameWhere(0); }

  const CsvTable& table_;
  const int num_joints_;
  const std::vector<KnownColumn> known_;
  FileErrors* errors_;
  RecordingLayout layout_;
  std::map<std::string, int> column_of_name_;
};

FieldColumns* ColumnFinder::Field(RecordingField field) {
  FieldColumns& columns = layout_.fields[field];
  if (columns.column.empty()) {
    int num_components = 0;
    for (const KnownColumn& known : known_) {
      if (known.field == field) num_components = std::max(num_components, known.component + 1);
    }
    columns.column.assign(num_components, -1);
    columns.to_si.assign(num_components, 1.0);
  }
  return &columns;
}

void ColumnFinder::PlaceKnown(int column_idx, const KnownColumn& known) {
  FieldColumns* const field = Field(known.field);
  int& place = field->column[known.component];
  if (place >= 0) {
    errors_->Error(table_.NameWhere(column_idx),
                   fmt::format("columns '{}' and '{}' give the same quantity; keep one of them",
                               table_.name(place),
                               known.name));
    return;
  }
  place = column_idx;
  field->to_si[known.component] = known.to_si;
}

void ColumnFinder::PlaceUnknown(int column_idx, const std::string& name) {
  const std::string mistake = MistakeInName(name, num_joints_, known_);
  if (!mistake.empty()) {
    errors_->Error(table_.NameWhere(column_idx), mistake);
    return;
  }
  layout_.unknown.push_back(column_idx);
}

void ColumnFinder::FindHints() {
  std::vector<std::string> absent;
  for (const KnownColumn& known : known_) {
    if (column_of_name_.count(known.name) == 0) absent.push_back(known.name);
  }
  for (const int column_idx : layout_.unknown) {
    layout_.hints.push_back(NearestName(table_.name(column_idx), absent));
  }
}

void ColumnFinder::Place(int column_idx) {
  const std::string name(table_.name(column_idx));
  if (name.empty()) return;
  if (!column_of_name_.emplace(name, column_idx).second) {
    errors_->Error(table_.NameWhere(column_idx),
                   fmt::format("column '{}' stands twice; keep one of them", Printable(name)));
    return;
  }
  const auto known = std::find_if(
      known_.begin(), known_.end(), [&](const KnownColumn& column) { return column.name == name; });
  if (known == known_.end()) {
    PlaceUnknown(column_idx, name);
  } else {
    PlaceKnown(column_idx, *known);
  }
}

std::string ColumnFinder::SpellingsOf(RecordingField field, int component) const {
  std::vector<std::string> names;
  for (const KnownColumn& known : known_) {
    if (known.field == field && known.component == component) names.push_back(known.name);
  }
  return QuotedList(names);
}

std::string ColumnFinder::NearestUnknown(const std::string& name) const {
  std::vector<std::string> names;
  for (const int column_idx : layout_.unknown) names.emplace_back(table_.name(column_idx));
  const std::string nearest = NearestName(name, names);
  return nearest.empty() ? "" : "; the nearest column is '" + Printable(nearest) + "'";
}

void ColumnFinder::CheckComplete(RecordingField field) {
  if (!layout_.Has(field)) return;
  const std::vector<int>& columns = layout_.fields.at(field).column;
  const int present = *std::max_element(columns.begin(), columns.end());
  std::string missing;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (columns[i] < 0) missing += (missing.empty() ? "" : " and ") + SpellingsOf(field, i);
  }
  if (missing.empty()) return;
  errors_->Error(table_.NameWhere(present),
                 fmt::format("column '{}' needs {} beside it", table_.name(present), missing));
}

void ColumnFinder::CheckJoints() {
  const std::vector<int> columns = Field(RecordingField::kJoint)->column;
  const auto num_missing = std::count(columns.begin(), columns.end(), -1);
  if (num_missing > 1 && num_missing == num_joints_) {
    errors_->Error(HeaderWhere(),
                   fmt::format("the recording has no joint coordinates; the columns {} to {} are "
                               "required{}",
                               SpellingsOf(RecordingField::kJoint, 0),
                               SpellingsOf(RecordingField::kJoint, num_joints_ - 1),
                               NearestUnknown("q1_deg")));
    return;
  }
  for (int i = 0; i < num_joints_; ++i) {
    if (columns[i] >= 0) continue;
    errors_->Error(HeaderWhere(),
                   fmt::format("the required column {} is missing{}",
                               SpellingsOf(RecordingField::kJoint, i),
                               NearestUnknown("q" + std::to_string(i + 1) + "_deg")));
  }
}

RecordingLayout ColumnFinder::Find() {
  for (int i = 0; i < table_.num_columns(); ++i) Place(i);
  FindHints();
  CheckJoints();
  CheckComplete(RecordingField::kPosition);
  CheckComplete(RecordingField::kDisplacement);
  CheckComplete(RecordingField::kQuaternion);
  if (layout_.Has(RecordingField::kTemperature) && layout_.Has(RecordingField::kJointTemperature)) {
    errors_->Error(table_.NameWhere(layout_.Column(RecordingField::kTemperature)),
                   "column 'temperature_C' stands beside temperatures per joint; keep one kind");
  }
  return std::move(layout_);
}

}  // namespace

RecordingLayout FindColumns(const CsvTable& table,
                            const std::vector<JointRow>& joints,
                            FileErrors* errors) {
  return ColumnFinder(table, joints, errors).Find();
}

}  // namespace dhcal
