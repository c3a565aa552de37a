#include "problems/formats/recording/recording_layout.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "problems/formats/recording/column_names.h"

namespace dhcal {

namespace {

/// The search behind FindColumns.
class ColumnFinder {
 public:
  ColumnFinder(const CellTable& table,
               const std::vector<JointRow>& joints,
               const std::vector<ColumnAlias>& aliases,
               FileErrors* errors,
               JointsIn joints_in)
      : table_(table),
        joints_in_(joints_in),
        num_joints_(static_cast<int>(joints.size())),
        known_(KnownColumns(joints)),
        names_(NameColumns(table, joints, known_, aliases, errors)),
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
  void CheckOrientation();
  /// A lone "yaw_deg" is somebody's own column.
  void DropPartOfAngles(RecordingField field);
  /// Asks for the header by an example with as many columns.
  std::string HeaderMissing() const;
  /// A name of one component: "q3_deg".
  std::string SpellingOf(RecordingField field, int component) const;
  /// The spellings of one component: "'q3_deg' or 'q3_rad'".
  std::string SpellingsOf(RecordingField field, int component) const;
  std::string NearestUnknown(const std::string& name) const;
  /// A place for what the header lacks.
  SourceLocation HeaderWhere() const { return table_.NameWhere(0); }

  const CellTable& table_;
  const JointsIn joints_in_;
  const int num_joints_;
  const std::vector<KnownColumn> known_;
  const ColumnNames names_;
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
                               table_.name(column_idx)));
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
    // Of a column that another one stands for, or that was asked about, enough is said.
    const bool said = names_.ours[column_idx].empty();
    layout_.hints.push_back(said ? "" : NearestName(table_.name(column_idx), absent));
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
  const std::string& ours = names_.ours[column_idx];
  const auto known = std::find_if(
      known_.begin(), known_.end(), [&](const KnownColumn& column) { return column.name == ours; });
  if (ours.empty()) {
    layout_.unknown.push_back(column_idx);
  } else if (known == known_.end()) {
    PlaceUnknown(column_idx, name);
  } else {
    PlaceKnown(column_idx, *known);
  }
}

std::string ColumnFinder::SpellingOf(RecordingField field, int component) const {
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const KnownColumn& column) {
    return column.field == field && column.component == component;
  });
  return known->name;
}

std::string ColumnFinder::SpellingsOf(RecordingField field, int component) const {
  std::vector<std::string> names;
  std::string stem;  // the first: a position's, not that of a matrix
  for (const KnownColumn& known : known_) {
    if (known.field != field || known.component != component) continue;
    if (stem.empty()) stem = known.stem;
    if (known.stem == stem) names.push_back(known.name);
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

std::string ColumnFinder::HeaderMissing() const {
  const char separator = table_.format().separator;
  std::string header, by_number;
  for (int i = 0; i < table_.num_columns(); ++i) {
    const int coordinate = i - num_joints_;
    std::string name = fmt::format("column{}", i + 1);
    if (coordinate < 0) {
      name = SpellingOf(RecordingField::kJoint, i);
    } else if (coordinate < 3) {
      name = SpellingOf(RecordingField::kPosition, coordinate);
    } else if (coordinate < 7 && table_.num_columns() >= num_joints_ + 7) {
      name = SpellingOf(RecordingField::kQuaternion, coordinate - 3);
    }
    if (i > 0) header += separator;
    header += name;
    if (coordinate < 3) {
      by_number += fmt::format("{}{}: {}", i == 0 ? "" : ", ", name, i + 1);
    }
  }
  return fmt::format(
      "row 1 holds numbers: the header is missing; write a line above that names the {} columns, "
      "such as {}, or number them in the problem file, such as columns: {{{}}}",
      table_.num_columns(),
      header,
      by_number);
}

void ColumnFinder::CheckJoints() {
  const std::vector<int> columns = Field(RecordingField::kJoint)->column;
  const auto num_missing = std::count(columns.begin(), columns.end(), -1);
  if (num_missing > 0 && !table_.has_header()) {
    return errors_->Error(HeaderWhere(), HeaderMissing());
  }
  if (num_missing > 0 && !names_.joints_refusal.empty()) {
    return errors_->Error(table_.NameWhere(names_.joints_column), names_.joints_refusal);
  }
  if (num_missing == num_joints_ && joints_in_ == JointsIn::kSomeTables) {
    layout_.fields.erase(RecordingField::kJoint);
    return;
  }
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

void ColumnFinder::DropPartOfAngles(RecordingField field) {
  if (!layout_.Has(field)) return;
  const std::vector<int> columns = layout_.fields.at(field).column;
  if (std::find(columns.begin(), columns.end(), -1) == columns.end()) return;
  for (const int column : columns) {
    if (column < 0) continue;
    layout_.unknown.push_back(column);
    layout_.hints.emplace_back();
  }
  layout_.fields.erase(field);
}

void ColumnFinder::CheckOrientation() {
  int first = -1;
  for (const RecordingField field : OrientationFields()) {
    const bool angles = field != RecordingField::kQuaternion && field != RecordingField::kMatrix;
    if (angles) DropPartOfAngles(field);
    CheckComplete(field);
    if (!layout_.Has(field)) continue;
    const std::vector<int>& columns = layout_.fields.at(field).column;
    const int column = *std::max_element(columns.begin(), columns.end());
    if (first >= 0) {
      errors_->Error(table_.NameWhere(column),
                     fmt::format("columns '{}' and '{}' both give the orientation; keep one form",
                                 table_.name(first),
                                 table_.name(column)));
    }
    first = column;
  }
}

RecordingLayout ColumnFinder::Find() {
  for (int i = 0; i < table_.num_columns(); ++i) Place(i);
  FindHints();
  CheckJoints();
  CheckComplete(RecordingField::kPosition);
  CheckComplete(RecordingField::kDisplacement);
  CheckComplete(RecordingField::kHead);
  CheckOrientation();
  if (!table_.has_header() && !errors_->ok()) {
    layout_.unknown.clear();
    layout_.hints.clear();
  }
  if (layout_.Has(RecordingField::kTemperature) && layout_.Has(RecordingField::kJointTemperature)) {
    errors_->Error(table_.NameWhere(layout_.Column(RecordingField::kTemperature)),
                   "column 'temperature_C' stands beside temperatures per joint; keep one kind");
  }
  return std::move(layout_);
}

}  // namespace

RecordingLayout FindColumns(const CellTable& table,
                            const std::vector<JointRow>& joints,
                            const std::vector<ColumnAlias>& aliases,
                            FileErrors* errors,
                            JointsIn joints_in) {
  return ColumnFinder(table, joints, aliases, errors, joints_in).Find();
}

}  // namespace dhcal
