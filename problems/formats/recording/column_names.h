// Which of our names each column of a file has: as the problem file says, as written, or by another
// spelling that can mean nothing else.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_NAMES_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_NAMES_H_

#include <string>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/file_errors.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "problems/formats/recording/recording_columns.h"

namespace dhcal {

struct ColumnNames {
  /// Per column: a name of ours where one is meant, else the file's own; "" = a column that another
  /// one stands for.
  std::vector<std::string> ours;
  /// Why the joint coordinates are not there, where more can be said than their names; and where.
  std::string joints_refusal;
  int joints_column = 0;

  // Columns that look like something, but are not taken for it; empty = none.
  std::vector<int> joints_without_unit;    // per joint
  std::vector<int> position_without_unit;  // x, y, z; -1 = absent
  std::vector<int> rotation_asked;         // rx, ry, rz
};

/// One note says which columns were read by other names. Errors in `aliases` stand at their places
/// in the problem file.
ColumnNames NameColumns(const CellTable& table,
                        const std::vector<JointRow>& joints,
                        const std::vector<KnownColumn>& known,
                        const std::vector<ColumnAlias>& aliases,
                        FileErrors* errors);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_COLUMN_NAMES_H_
