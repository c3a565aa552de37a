// Which of a recording's columns a file has, and where.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_LAYOUT_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_LAYOUT_H_

#include <map>
#include <string>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/file_errors.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "problems/formats/recording/recording_columns.h"

namespace dhcal {

/// Where the components of one field stand in the file.
struct FieldColumns {
  std::vector<int> column;    // per component; -1 = absent
  std::vector<double> to_si;  // per component
};

struct RecordingLayout {
  std::map<RecordingField, FieldColumns> fields;  // only those present
  std::vector<int> unknown;                       // columns without a meaning here
  std::vector<std::string> hints;                 // per unknown one: the nearest name, or ""

  bool Has(RecordingField field) const { return fields.count(field) > 0; }
  /// First column of a field that has only one component.
  int Column(RecordingField field) const { return fields.at(field).column[0]; }
};

/// Whether a table without joint coordinates is one of ours: desired poses need none.
enum class JointsIn { kAllTables, kSomeTables };

/// Reports missing, doubled, incomplete and misnamed columns.
RecordingLayout FindColumns(const CellTable& table,
                            const std::vector<JointRow>& joints,
                            const std::vector<ColumnAlias>& aliases,
                            FileErrors* errors,
                            JointsIn joints_in = JointsIn::kAllTables);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_LAYOUT_H_
