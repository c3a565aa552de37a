// Finds the columns of the joint coordinates by other names than ours: the robot's own joint names,
// those of ROS, numbered ones such as J1 or axis_1.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_JOINT_COLUMNS_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_JOINT_COLUMNS_H_

#include <string>
#include <vector>

#include "core/io/cell_table.h"
#include "core/model/robot.h"
#include "problems/formats/recording/column_spelling.h"

namespace dhcal {

struct JointColumns {
  std::vector<int> column;        // one per joint; empty = none found
  std::vector<std::string> unit;  // "deg", "rad", "mm" or "m"; empty = they cannot be told
  std::string remark;             // how order and unit were told, where the names do not say it
  std::string refusal;            // why the columns found are not taken, and the line that cures it
};

/// Looks among the columns that are `free`. All joints must be of one family of names; a robot's
/// own names win over numbers, names with units over those without. A unit is taken from the name,
/// from ROS, or from angles that no radians reach; it is not guessed.
JointColumns FindJointColumns(const CellTable& table,
                              const std::vector<ColumnSpelling>& spellings,
                              const std::vector<bool>& free,
                              const std::vector<JointRow>& joints);

/// "columns: {q1_deg: J1, q2_deg: J2}": the line of a problem file that says which column is which.
/// Prismatic joints are in mm.
std::string ColumnsLine(const CellTable& table,
                        const std::vector<int>& columns,
                        const std::vector<JointRow>& joints,
                        const std::string& angle_unit = "deg");

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_JOINT_COLUMNS_H_
