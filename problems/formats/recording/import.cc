#include "problems/formats/recording/import.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/io/cell_table.h"
#include "core/io/file_errors.h"
#include "problems/formats/recording/column_names.h"
#include "problems/formats/recording/column_spelling.h"
#include "problems/formats/recording/joint_columns.h"
#include "problems/formats/recording/recording_columns.h"

namespace dhcal {

namespace {

std::vector<JointRow> TurningJoints(int number) {
  std::vector<JointRow> joints(number);
  for (int i = 0; i < number; ++i) joints[i].name = "J" + std::to_string(i + 1);
  return joints;
}

class Importer {
 public:
  Importer(const CellTable& table, std::vector<JointRow> joints)
      : table_(table), joints_(std::move(joints)) {}

  std::string Import();

 private:
  /// The most joints that the file's names speak of.
  int CountJoints() const;
  void AddKnown();
  void AddJointsWithoutUnit();
  void AddRosJoints();
  void AddPositionWithoutUnit();
  void AddByPlace();
  void FindRotation();
  void AddRotation();
  void AddRest();
  void Add(const std::string& ours, int column_idx, const std::string& how);
  std::string FirstValues(int column_idx) const;
  double Largest(const std::vector<int>& columns) const;

  const CellTable& table_;
  std::vector<JointRow> joints_;
  ColumnNames names_;
  std::set<int> used_;
  std::string lines_, comments_;
};

int Importer::CountJoints() const {
  constexpr int kMost = 12, kUsual = 6;
  std::vector<ColumnSpelling> spellings;
  for (int i = 0; i < table_.num_columns(); ++i) spellings.push_back(Spell(table_.name(i)));
  const std::vector<bool> free(spellings.size(), true);
  for (int number = kMost; number > 1; --number) {
    if (!FindJointColumns(table_, spellings, free, TurningJoints(number)).column.empty()) {
      return number;
    }
  }
  return kUsual;
}

std::string Importer::FirstValues(int column_idx) const {
  constexpr int kValues = 3;
  std::string values;
  for (int row = 0; row < std::min(kValues, table_.num_rows()); ++row) {
    values += (row > 0 ? ", " : "") + Printable(table_.cell(row, column_idx));
  }
  return values;
}

double Importer::Largest(const std::vector<int>& columns) const {
  double largest = 0;
  for (const int column : columns) {
    for (int row = 0; column >= 0 && row < table_.num_rows(); ++row) {
      largest = std::max(largest, std::abs(ParseDouble(table_.cell(row, column)).value_or(0)));
    }
  }
  return largest;
}

void Importer::Add(const std::string& ours, int column_idx, const std::string& how) {
  used_.insert(column_idx);
  lines_ += fmt::format("  {:<40}# {}: {}\n",
                        fmt::format("{}: {}", ours, YamlWord(table_.name(column_idx))),
                        how,
                        FirstValues(column_idx));
}

void Importer::AddKnown() {
  const std::vector<KnownColumn> known = KnownColumns(joints_);
  for (const KnownColumn& column : known) {
    for (int i = 0; i < table_.num_columns(); ++i) {
      if (names_.ours[i] == column.name) {
        Add(column.name, i, table_.name(i) == column.name ? "as named" : "by its name");
      }
    }
  }
}

void Importer::AddJointsWithoutUnit() {
  const std::vector<int>& columns = names_.joints_without_unit;
  if (columns.empty()) return;
  const bool degrees = Largest(columns) > 2 * kPi;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool turns = joints_[i].type == JointType::kRevolute;
    const std::string unit = turns ? (degrees ? "deg" : "rad") : "mm";
    Add(fmt::format("q{}_{}", i + 1, unit), columns[i], "GUESS, check the unit");
  }
}

void Importer::AddPositionWithoutUnit() {
  constexpr double kLongestArm = 10;  // [m]
  const std::vector<int>& columns = names_.position_without_unit;
  const std::string unit = Largest(columns) > kLongestArm ? "mm" : "m";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] < 0) continue;
    Add(fmt::format("{}_{}", "xyz"[i], unit), columns[i], "GUESS, check the unit");
  }
}

/// Names of joints that no problem file tells: ROS ends them in "_joint".
void Importer::AddRosJoints() {
  const bool found = std::any_of(names_.ours.begin(),
                                 names_.ours.end(),
                                 [](const std::string& name) { return StartsWith(name, "q1_"); });
  if (found || !names_.joints_without_unit.empty()) return;
  std::vector<int> columns;
  for (int i = 0; i < table_.num_columns(); ++i) {
    const std::string words = Spell(table_.name(i)).words;
    if (EndsWith(words, "_joint") || EndsWith(words, "_joint_position")) columns.push_back(i);
  }
  const std::string unit = Largest(columns) > 2 * kPi ? "deg" : "rad";
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Add(fmt::format("q{}_{}", k + 1, unit), columns[k], "GUESS, check the order and the unit");
  }
}

/// Words that end as a tracker's do: "measurement_rx".
void Importer::FindRotation() {
  if (!names_.rotation_asked.empty()) return;
  std::vector<int> columns(3, -1);
  for (int i = 0; i < table_.num_columns(); ++i) {
    const std::string words = Spell(table_.name(i)).words;
    if (words.find("std") != std::string::npos) continue;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (EndsWith(words, std::string("_r") + "xyz"[k])) columns[k] = i;
    }
  }
  if (*std::min_element(columns.begin(), columns.end()) >= 0) names_.rotation_asked = columns;
}

/// Without a header: joints first, then the position.
void Importer::AddByPlace() {
  if (table_.has_header()) return;
  const int num_joints = std::min(static_cast<int>(joints_.size()), table_.num_columns());
  for (int i = 0; i < num_joints; ++i) names_.joints_without_unit.push_back(i);
  for (int i = num_joints; i < std::min(num_joints + 3, table_.num_columns()); ++i) {
    names_.position_without_unit.push_back(i);
  }
}

void Importer::AddRotation() {
  const std::vector<int>& columns = names_.rotation_asked;
  if (columns.empty()) return;
  const std::string unit = Largest(columns) > 2 * kPi ? "deg" : "rad";
  for (const auto& [words, stems] :
       {std::pair("if it is a rotation vector (Universal Robots)",
                  std::vector<std::string>{"rotvec_x", "rotvec_y", "rotvec_z"}),
        std::pair("if these are angles about the fixed axes x, then y, then z",
                  std::vector<std::string>{"roll", "pitch", "yaw"}),
        std::pair("if these are angles about the turning axes x, y, z",
                  std::vector<std::string>{"euler_xyz_x", "euler_xyz_y", "euler_xyz_z"})}) {
    lines_ += fmt::format("  # {}:\n", words);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      lines_ += fmt::format("  # {}_{}: {}\n", stems[k], unit, YamlWord(table_.name(columns[k])));
      used_.insert(columns[k]);
    }
  }
}

void Importer::AddRest() {
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (used_.count(i) > 0 || table_.name(i).empty()) continue;
    comments_ += fmt::format("#   {}: {}\n", Printable(table_.name(i)), FirstValues(i));
  }
  if (!comments_.empty()) {
    comments_ =
        "# Columns without a meaning here; numeric ones are tried as drivers:\n" + comments_;
  }
}

std::string Importer::Import() {
  if (joints_.empty()) joints_ = TurningJoints(CountJoints());
  FileErrors unsaid("");
  names_ = NameColumns(table_, joints_, KnownColumns(joints_), {}, &unsaid);
  AddByPlace();
  AddKnown();
  AddJointsWithoutUnit();
  AddRosJoints();
  AddPositionWithoutUnit();
  FindRotation();
  AddRotation();
  AddRest();
  if (lines_.empty())
    lines_ = "  {}  # no column is recognised; write lines such as q1_deg: NAME\n";
  return "# For the problem file: our names of columns, and those of the recording. Check the "
         "lines\n"
         "# marked GUESS; names and units: problems/FORMATS.md, section 1.\n"
         "columns:\n" +
         lines_ + comments_;
}

}  // namespace

std::optional<std::string> ImportColumns(const std::string& file,
                                         std::vector<JointRow> joints,
                                         Diagnostics* diagnostics) {
  FileErrors errors(file);
  std::optional<std::string> text;
  if (const std::optional<CellTable> table = ReadTable(file, &errors, IsUnitWord)) {
    text = Importer(*table, std::move(joints)).Import();
  }
  errors.Report(diagnostics);
  return text;
}

}  // namespace dhcal
