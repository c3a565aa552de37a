#include "problems/formats/recording/joint_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {

namespace {

/// Columns that may be the joints', one per joint.
struct Family {
  std::vector<int> column;
  bool by_name = false;
  bool si = false;     // ROS states rad and m
  std::string remark;  // how the order was told
};

/// Words before the number of a joint coordinate.
bool IsJointWord(const std::string& words) {
  static constexpr std::array<std::string_view, 15> kWords = {"q",
                                                              "j",
                                                              "a",
                                                              "joint",
                                                              "axis",
                                                              "theta",
                                                              "achse",
                                                              "joint_angle",
                                                              "joint_position",
                                                              "joint_positions",
                                                              "joint_pos",
                                                              "axis_angle",
                                                              "position",
                                                              "joint_actual",
                                                              "actual_joint"};
  return std::find(kWords.begin(), kWords.end(), words) != kWords.end();
}

/// Arrays of ROS' sensor_msgs/JointState, and of UR's real-time data: in SI.
bool IsSiArray(const std::string& words) {
  return EndsWith(words, "joint_states_position") || EndsWith(words, "joint_state_position") ||
         words == "field_position" || words == "actual_q";
}

std::string Squeezed(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '_'), text.end());
  return text;
}

/// Without a word at its end or start; false when it does not stand there.
bool Strip(std::string_view prefix, std::string_view suffix, std::string* words) {
  const bool fits = words->size() > prefix.size() + suffix.size() && StartsWith(*words, prefix) &&
                    EndsWith(*words, suffix);
  if (fits) *words = words->substr(prefix.size(), words->size() - prefix.size() - suffix.size());
  return fits;
}

/// The joint's name as files write it in different places, without "_joint".
std::string JointNameKey(const std::string& name) {
  std::string words = Spell(name).all_words();
  Strip("", "_joint", &words);
  return Squeezed(words);
}

/// Whether a column's words are the name of a joint, with or without what ROS puts around it.
bool NamesJoint(std::string words, const std::string& key) {
  if (key.empty()) return false;
  while (true) {
    if (Squeezed(words) == key) return true;
    const bool shorter = Strip("", "_position", &words) || Strip("", "_pos", &words) ||
                         Strip("", "_angle", &words) || Strip("", "_actual", &words) ||
                         Strip("", "_measured", &words) || Strip("", "_joint", &words) ||
                         Strip("joint_states_", "", &words) || Strip("joint_state_", "", &words) ||
                         Strip("actual_", "", &words) || Strip("measured_", "", &words) ||
                         Strip("joint_", "", &words);
    if (!shorter) return false;
  }
}

class JointFinder {
 public:
  JointFinder(const CellTable& table,
              const std::vector<ColumnSpelling>& spellings,
              const std::vector<bool>& free,
              const std::vector<JointRow>& joints)
      : table_(table), spellings_(spellings), free_(free), joints_(joints) {}

  JointColumns Find();

 private:
  int num_joints() const { return static_cast<int>(joints_.size()); }
  void FindByName();
  void FindByNumber();
  /// The order of a ROS array from the names beside it, "field.name0"; nothing without them.
  std::optional<Family> OrderedByNames(const std::string& words,
                                       const std::map<int, int>& column_of_number);
  /// The unit that all names of a family state, per joint; empty when they state none.
  std::optional<std::vector<std::string>> UnitsStated(const Family& family) const;
  /// Angles that no radians reach, so that they must be degrees.
  bool BeyondRadians(const Family& family) const;
  double Largest(int column_idx) const;
  void Settle(const Family& family);
  void SettleUnits(const Family& family);

  const CellTable& table_;
  const std::vector<ColumnSpelling>& spellings_;
  const std::vector<bool>& free_;
  const std::vector<JointRow>& joints_;
  std::vector<Family> families_;
  JointColumns result_;
};

void JointFinder::FindByName() {
  Family family;
  family.by_name = true;
  for (const JointRow& joint : joints_) {
    const std::string key = JointNameKey(joint.name);
    for (int i = 0; i < table_.num_columns(); ++i) {
      if (!free_[i] || !NamesJoint(spellings_[i].all_words(), key)) continue;
      family.column.push_back(i);
      family.si = StartsWith(spellings_[i].words, "joint_state");
    }
  }
  // Two columns of one joint are two families, and which is meant nobody knows.
  if (static_cast<int>(family.column.size()) == num_joints()) families_.push_back(family);
}

std::optional<Family> JointFinder::OrderedByNames(const std::string& words,
                                                  const std::map<int, int>& column_of_number) {
  constexpr std::string_view kPosition = "position";
  if (!EndsWith(words, kPosition)) return std::nullopt;
  const std::string name_words = words.substr(0, words.size() - kPosition.size()) + "name";
  Family family;
  family.by_name = true;
  family.si = true;
  family.column.assign(joints_.size(), -1);
  bool any = false;
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (spellings_[i].words != name_words || !spellings_[i].number) continue;
    any = true;
    const auto position = column_of_number.find(*spellings_[i].number);
    if (position == column_of_number.end()) continue;
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      if (!NamesJoint(Spell(table_.cell(0, i)).all_words(), JointNameKey(joints_[joint].name))) {
        continue;
      }
      family.column[joint] = position->second;
    }
  }
  if (!any) return std::nullopt;
  family.remark = "in the order of the names beside them";
  return family;
}

void JointFinder::FindByNumber() {
  std::map<std::string, std::map<int, int>> families;  // words -> number -> column
  for (int i = 0; i < table_.num_columns(); ++i) {
    const ColumnSpelling& spelling = spellings_[i];
    if (!free_[i] || !spelling.number) continue;
    if (!IsJointWord(spelling.words) && !IsSiArray(spelling.words)) continue;
    families[spelling.words].emplace(*spelling.number, i);
  }
  for (const auto& [words, column_of_number] : families) {
    if (const std::optional<Family> ordered = OrderedByNames(words, column_of_number)) {
      const std::vector<int>& columns = ordered->column;
      if (std::find(columns.begin(), columns.end(), -1) == columns.end()) {
        families_.push_back(*ordered);
      } else {
        result_.refusal =
            "the recording names its joints otherwise than the problem file does; give "
            "'robot.joints' the names of the recording";
      }
      continue;
    }
    const int first = column_of_number.count(0) > 0 ? 0 : 1;
    // Some numbers more than joints: which are the robot's, nobody knows.
    if (static_cast<int>(column_of_number.size()) != num_joints()) continue;
    Family family;
    family.si = IsSiArray(words);
    if (family.si && words != "actual_q") {
      family.remark = "in the order of the file, which in ROS is often the alphabet's";
    }
    for (const auto& [number, column] : column_of_number) {
      if (number == first + static_cast<int>(family.column.size())) family.column.push_back(column);
    }
    if (static_cast<int>(family.column.size()) == num_joints()) families_.push_back(family);
  }
}

std::optional<std::vector<std::string>> JointFinder::UnitsStated(const Family& family) const {
  std::vector<std::string> units;
  for (int joint = 0; joint < num_joints(); ++joint) {
    const std::string& unit = spellings_[family.column[joint]].unit;
    const bool turns = joints_[joint].type == JointType::kRevolute;
    if (unit.empty()) continue;
    if (unit != (turns ? "deg" : "mm") && unit != (turns ? "rad" : "m")) return std::nullopt;
    units.push_back(unit);
  }
  if (!units.empty() && static_cast<int>(units.size()) != num_joints()) return std::nullopt;
  return units;
}

double JointFinder::Largest(int column_idx) const {
  double largest = 0;
  for (int row = 0; row < table_.num_rows(); ++row) {
    largest = std::max(largest, std::abs(ParseDouble(table_.cell(row, column_idx)).value_or(0)));
  }
  return largest;
}

bool JointFinder::BeyondRadians(const Family& family) const {
  // Wrists turn more than once, so one joint beyond a turn proves nothing.
  int beyond_one_turn = 0;
  bool beyond_two_turns = false;
  for (int joint = 0; joint < num_joints(); ++joint) {
    if (joints_[joint].type != JointType::kRevolute) return false;
    const double largest = Largest(family.column[joint]);
    if (largest > 2 * kPi) ++beyond_one_turn;
    beyond_two_turns = beyond_two_turns || largest > 4 * kPi;
  }
  return beyond_two_turns && 2 * beyond_one_turn >= num_joints();
}

void JointFinder::SettleUnits(const Family& family) {
  result_.unit = UnitsStated(family).value();
  if (!result_.unit.empty()) return;
  const bool degrees = !family.si && BeyondRadians(family);
  if (!family.si && !degrees) {
    result_.refusal = fmt::format(
        "columns '{}' to '{}' look like the joint coordinates, but state no unit; write one into "
        "the header, or into the problem file: {} (or q1_rad ...)",
        Printable(table_.name(family.column.front())),
        Printable(table_.name(family.column.back())),
        ColumnsLine(table_, family.column, joints_));
    return;
  }
  for (const JointRow& joint : joints_) {
    const bool turns = joint.type == JointType::kRevolute;
    result_.unit.emplace_back(turns ? (degrees ? "deg" : "rad") : "m");
  }
  if (!result_.remark.empty()) result_.remark += ", ";
  result_.remark += degrees ? "in degrees, as they go beyond two turns of radians"
                            : "in SI units, as their source writes them";
}

void JointFinder::Settle(const Family& family) {
  result_.column = family.column;
  result_.remark = family.remark;
  result_.refusal.clear();
  SettleUnits(family);
}

JointColumns JointFinder::Find() {
  FindByName();
  FindByNumber();
  for (const bool stated : {true, false}) {
    for (const bool by_name : {true, false}) {
      std::vector<const Family*> fitting;
      for (const Family& family : families_) {
        const auto units = UnitsStated(family);
        const bool has_units = units && !units->empty();
        if (!units || family.by_name != by_name || has_units != stated) continue;
        // "J1" is found by the name J1 and by its number.
        const bool known = std::any_of(fitting.begin(), fitting.end(), [&](const Family* other) {
          return other->column == family.column;
        });
        if (!known) fitting.push_back(&family);
      }
      if (fitting.empty()) continue;
      Settle(*fitting.front());
      if (fitting.size() == 1) return result_;
      result_.unit.clear();
      result_.refusal = fmt::format(
          "columns '{}' and '{}' both may be of joint 1; say in the problem file which "
          "ones are, as: {}",
          Printable(table_.name(fitting[0]->column[0])),
          Printable(table_.name(fitting[1]->column[0])),
          ColumnsLine(table_, fitting[0]->column, joints_));
      return result_;
    }
  }
  return result_;
}

}  // namespace

std::string ColumnsLine(const CellTable& table,
                        const std::vector<int>& columns,
                        const std::vector<JointRow>& joints,
                        const std::string& angle_unit) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool turns = joints[i].type == JointType::kRevolute;
    line += fmt::format("{}q{}_{}: {}",
                        line.empty() ? "" : ", ",
                        i + 1,
                        turns ? angle_unit : "mm",
                        YamlWord(table.name(columns[i])));
  }
  return "columns: {" + line + "}";
}

JointColumns FindJointColumns(const CellTable& table,
                              const std::vector<ColumnSpelling>& spellings,
                              const std::vector<bool>& free,
                              const std::vector<JointRow>& joints) {
  return JointFinder(table, spellings, free, joints).Find();
}

}  // namespace dhcal
