#include "problems/formats/recording/column_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "problems/formats/recording/column_spelling.h"
#include "problems/formats/recording/column_words.h"
#include "problems/formats/recording/joint_columns.h"

namespace dhcal {

namespace {

class ColumnNamer {
 public:
  ColumnNamer(const CellTable& table,
              const std::vector<JointRow>& joints,
              const std::vector<KnownColumn>& known,
              const std::vector<ColumnAlias>& aliases,
              FileErrors* errors);

  ColumnNames Name();

 private:
  const KnownColumn* FindKnown(const std::string& name) const;
  /// The column of ours that a spelling with its unit means; null when it is none.
  const KnownColumn* FindMeant(int column_idx) const;
  void TakeAlias(const ColumnAlias& alias);
  int ColumnOf(const ColumnAlias& alias) const;
  void TakeExactNames();
  void TakeSpellings();
  void TakeJoints();
  void WarnOfPositionWithoutUnit();
  void AskForRotation();
  void Take(int column_idx, const KnownColumn& known);
  void WriteNote() const;

  const CellTable& table_;
  const std::vector<JointRow>& joints_;
  const std::vector<KnownColumn>& known_;
  const std::vector<ColumnAlias>& aliases_;
  FileErrors* errors_;
  std::vector<ColumnSpelling> spellings_;
  std::map<std::string, std::string> known_spellings_;  // words, number and unit -> our name
  std::vector<bool> free_;
  std::set<std::string> stems_;  // quantities that have a column
  std::vector<int> respelt_;     // columns read by another name
  std::string remark_;
  ColumnNames names_;
};

/// Words, number and unit.
std::string KeyOf(const std::string& words, const ColumnSpelling& spelling) {
  const std::string number = spelling.number ? std::to_string(*spelling.number) : "";
  return words + "|" + number + "|" + spelling.unit;
}

ColumnNamer::ColumnNamer(const CellTable& table,
                         const std::vector<JointRow>& joints,
                         const std::vector<KnownColumn>& known,
                         const std::vector<ColumnAlias>& aliases,
                         FileErrors* errors)
    : table_(table),
      joints_(joints),
      known_(known),
      aliases_(aliases),
      errors_(errors),
      free_(table.num_columns(), true) {
  for (int i = 0; i < table.num_columns(); ++i) {
    spellings_.push_back(Spell(table.name(i)));
    names_.ours.emplace_back(table.name(i));
    free_[i] = !table.name(i).empty();
  }
  for (const KnownColumn& column : known) {
    const ColumnSpelling spelling = Spell(column.name);
    known_spellings_.emplace(KeyOf(spelling.words, spelling), column.name);
  }
}

const KnownColumn* ColumnNamer::FindKnown(const std::string& name) const {
  const auto found = std::find_if(
      known_.begin(), known_.end(), [&](const KnownColumn& known) { return known.name == name; });
  return found == known_.end() ? nullptr : &*found;
}

const KnownColumn* ColumnNamer::FindMeant(int column_idx) const {
  const ColumnSpelling meant = ComponentOf(table_.name(column_idx), spellings_[column_idx]);
  const auto found = known_spellings_.find(KeyOf(OurWords(meant.words), meant));
  return found == known_spellings_.end() ? nullptr : FindKnown(found->second);
}

void ColumnNamer::Take(int column_idx, const KnownColumn& known) {
  names_.ours[column_idx] = known.name;
  free_[column_idx] = false;
  stems_.insert(known.stem);
}

int ColumnNamer::ColumnOf(const ColumnAlias& alias) const {
  std::vector<std::string> names;
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (table_.name(i) == alias.theirs || table_.own_name(i) == alias.theirs) return i;
    names.emplace_back(table_.own_name(i));
  }
  const std::string nearest = NearestName(alias.theirs, names);
  errors_->Error(
      alias.theirs_where,
      fmt::format("the recording {} has no column '{}'{}",
                  errors_->file(),
                  Printable(alias.theirs),
                  nearest.empty() ? "" : "; did you mean '" + Printable(nearest) + "'?"));
  return -1;
}

void ColumnNamer::TakeAlias(const ColumnAlias& alias) {
  const KnownColumn* const known = FindKnown(alias.ours);
  if (known == nullptr) {
    std::vector<std::string> names;
    for (const KnownColumn& column : known_) names.push_back(column.name);
    const std::string nearest = NearestName(alias.ours, names);
    errors_->Error(alias.ours_where,
                   fmt::format("'{}' is no column of a recording of this robot{}; the names that "
                               "there are stand in problems/FORMATS.md, section 1",
                               Printable(alias.ours),
                               nearest.empty() ? "" : ", did you mean '" + nearest + "'?"));
    return;
  }
  const int column = ColumnOf(alias);
  if (column >= 0) Take(column, *known);
}

void ColumnNamer::TakeExactNames() {
  // What the problem file names another column for is no longer meant.
  const std::set<std::string> given = stems_;
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (!free_[i]) continue;
    const KnownColumn* const known = FindKnown(names_.ours[i]);
    if (known == nullptr) continue;
    if (given.count(known->stem) > 0) {
      names_.ours[i].clear();
      free_[i] = false;
    } else {
      Take(i, *known);
    }
  }
}

void ColumnNamer::TakeSpellings() {
  const std::set<std::string> given = stems_;
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (!free_[i]) continue;
    const KnownColumn* const known = FindMeant(i);
    if (known == nullptr || given.count(known->stem) > 0) continue;
    Take(i, *known);
    respelt_.push_back(i);
  }
}

void ColumnNamer::TakeJoints() {
  for (std::size_t i = 1; i <= joints_.size(); ++i) {
    if (stems_.count("q" + std::to_string(i)) > 0) return;
  }
  const JointColumns found = FindJointColumns(table_, spellings_, free_, joints_);
  names_.joints_refusal = found.refusal;
  if (!found.column.empty()) names_.joints_column = found.column[0];
  for (const int column : found.column) free_[column] = false;
  if (!found.refusal.empty()) {
    names_.joints_without_unit = found.column;
    // Nor are they drivers of anything, or mistakes in names.
    for (const int column : found.column) names_.ours[column].clear();
    return;
  }
  for (std::size_t i = 0; i < found.column.size(); ++i) {
    const KnownColumn* const known = FindKnown("q" + std::to_string(i + 1) + "_" + found.unit[i]);
    if (known != nullptr) Take(found.column[i], *known);
    respelt_.push_back(found.column[i]);
  }
  remark_ = found.remark;
}

void ColumnNamer::WarnOfPositionWithoutUnit() {
  std::string line;
  int first = -1;
  std::vector<int> columns;
  for (const std::string axis : {"x", "y", "z"}) {
    columns.push_back(-1);
    for (int i = 0; i < table_.num_columns(); ++i) {
      const bool meant = free_[i] && OurWords(spellings_[i].words) == axis &&
                         spellings_[i].unit.empty() && !spellings_[i].number &&
                         stems_.count(axis) == 0 &&
                         table_.name(i) != axis;  // is an error elsewhere
      if (!meant) continue;
      free_[i] = false;
      columns.back() = i;
      if (first < 0) first = i;
      line += fmt::format("{}{}_mm: {}", line.empty() ? "" : ", ", axis, YamlWord(table_.name(i)));
    }
  }
  if (first < 0) return;
  names_.position_without_unit = columns;
  errors_->Warning(
      table_.NameWhere(first),
      fmt::format("column '{}' looks like a position, but states no unit and is not read as one; "
                  "write the unit into the header, or into the problem file: columns: {{{}}} (or "
                  "x_m ...)",
                  Printable(table_.name(first)),
                  line));
}

void ColumnNamer::AskForRotation() {
  std::array<int, 3> columns = {-1, -1, -1};
  const std::array<std::string, 3> words = {"rx", "ry", "rz"};
  for (int i = 0; i < table_.num_columns(); ++i) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (free_[i] && spellings_[i].words == words[k]) columns[k] = i;
    }
  }
  if (*std::min_element(columns.begin(), columns.end()) < 0) return;
  for (const char* const stem : {"qw", "rotvec_x", "roll", "a", "euler_xyz_x", "m11"}) {
    if (stems_.count(stem) > 0) return;
  }
  names_.rotation_asked.assign(columns.begin(), columns.end());
  for (const int column : columns) names_.ours[column].clear();
  const std::string unit = spellings_[columns[0]].unit == "deg" ? "deg" : "rad";
  const auto line = [&](const std::array<std::string, 3>& stems) {
    std::string text;
    for (std::size_t k = 0; k < stems.size(); ++k) {
      text += fmt::format(
          "{}{}_{}: {}", k == 0 ? "" : ", ", stems[k], unit, YamlWord(table_.name(columns[k])));
    }
    return "columns: {" + text + "}";
  };
  errors_->Warning(
      table_.NameWhere(columns[0]),
      fmt::format(
          "'{}' to '{}' may be a rotation vector or angles, and are not read; as a rotation "
          "vector (Universal Robots) write in the problem file: {}; as angles about the "
          "fixed x, then y, then z: {}; about the turning x, y, z: {}",
          Printable(table_.name(columns[0])),
          Printable(table_.name(columns[2])),
          line({"rotvec_x", "rotvec_y", "rotvec_z"}),
          line({"roll", "pitch", "yaw"}),
          line({"euler_xyz_x", "euler_xyz_y", "euler_xyz_z"})));
}

void ColumnNamer::WriteNote() const {
  if (respelt_.empty()) return;
  std::string list;
  for (const int column : respelt_) {
    list += fmt::format("{}{} = '{}'",
                        list.empty() ? "" : ", ",
                        names_.ours[column],
                        Printable(table_.name(column)));
  }
  errors_->Note(
      table_.NameWhere(respelt_.front()),
      fmt::format(
          "columns read by other names: {}{}", list, remark_.empty() ? "" : "; joints " + remark_));
}

ColumnNames ColumnNamer::Name() {
  for (const ColumnAlias& alias : aliases_) TakeAlias(alias);
  TakeExactNames();
  TakeSpellings();
  TakeJoints();
  WarnOfPositionWithoutUnit();
  AskForRotation();
  WriteNote();
  return std::move(names_);
}

}  // namespace

ColumnNames NameColumns(const CellTable& table,
                        const std::vector<JointRow>& joints,
                        const std::vector<KnownColumn>& known,
                        const std::vector<ColumnAlias>& aliases,
                        FileErrors* errors) {
  return ColumnNamer(table, joints, known, aliases, errors).Name();
}

}  // namespace dhcal
