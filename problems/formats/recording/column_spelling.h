// Takes the name of a column apart, however it is written: "X [mm]", "joint_1 (deg)",
// "/joint_states/position[0]". It knows units and numbers, not what the words mean.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_SPELLING_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_SPELLING_H_

#include <optional>
#include <string>
#include <string_view>

namespace dhcal {

struct ColumnSpelling {
  std::string words;          // in lower case, joined by '_', without unit and number: "joint"
  std::optional<int> number;  // at the end: "J1", "joint_1", "position[0]"
  std::string unit;           // as in our names: "mm", "deg", "deg_s", "Nm"; "" = none

  /// With the number, as names of joints are compared: "wrist_1_joint".
  std::string all_words() const;
};

ColumnSpelling Spell(std::string_view name);

/// True for a unit as people write it: "mm", "degrees".
bool IsUnitWord(std::string_view text);

/// `text` as a key or value of a YAML map in braces: in quotes where it needs them.
std::string YamlWord(std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_SPELLING_H_
