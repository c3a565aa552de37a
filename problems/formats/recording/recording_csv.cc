// A recording in the program's own input format, in SI units, so that no number changes.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/csv_text.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

/// A column of the file; `append` writes its cell of a row.
struct Column {
  std::string name;
  std::function<void(int row_idx, CsvText* csv)> append;
};

using Columns = std::vector<Column>;

/// Nothing when the matrix is absent. `names` has one name per column.
void AddMatrix(const std::vector<std::string>& names,
               const Eigen::MatrixXd& matrix,
               Columns* columns) {
  if (matrix.rows() == 0) return;
  for (int j = 0; j < static_cast<int>(matrix.cols()); ++j) {
    columns->push_back(
        {names[j], [&matrix, j](int row_idx, CsvText* csv) { csv->Number(matrix(row_idx, j)); }});
  }
}

void AddVector(const std::string& name, const Eigen::VectorXd& vector, Columns* columns) {
  if (vector.size() == 0) return;
  columns->push_back(
      {name, [&vector](int row_idx, CsvText* csv) { csv->Number(vector[row_idx]); }});
}

void AddLabels(const std::string& name,
               const std::vector<std::string>& labels,
               const std::vector<int>& label_idx,
               Columns* columns) {
  if (label_idx.empty()) return;
  columns->push_back({name, [&labels, &label_idx](int row_idx, CsvText* csv) {
                        const int index = label_idx[row_idx];
                        csv->Label(index < 0 ? std::string() : labels[index]);
                      }});
}

/// "q1_rad", "q2_m" ... by the type of each joint.
std::vector<std::string> JointNames(const std::string& stem,
                                    const std::string& revolute_unit,
                                    const std::string& prismatic_unit,
                                    const RobotModel& robot) {
  std::vector<std::string> names;
  for (const JointRow& joint : robot.joints) {
    names.push_back(stem + std::to_string(names.size() + 1) +
                    (joint.type == JointType::kPrismatic ? prismatic_unit : revolute_unit));
  }
  return names;
}

void AddJointColumns(const Recording& recording, const RobotModel& robot, Columns* columns) {
  AddMatrix(JointNames("dir", "", "", robot), recording.direction, columns);
  AddMatrix(JointNames("qd", "_rad_s", "_m_s", robot), recording.speed, columns);
  AddMatrix(JointNames("torque", "_Nm", "_N", robot), recording.torque, columns);
  const bool one_temperature = recording.temperature.cols() == 1;
  AddMatrix(one_temperature ? std::vector<std::string>{"temperature_C"}
                            : JointNames("temperature", "_C", "_C", robot),
            recording.temperature,
            columns);
}

void AddMeasuredColumns(const Recording& recording, Columns* columns) {
  AddMatrix({"x_m", "y_m", "z_m"}, recording.p_WQ, columns);
  AddMatrix({"dx_m", "dy_m", "dz_m"}, recording.displacement, columns);
  AddMatrix({"qw", "qx", "qy", "qz"}, recording.quaternion, columns);
  AddVector("distance_m", recording.distance, columns);
  AddMatrix({"ruler_m", "height1_m", "height2_m"}, recording.head, columns);
  AddVector("sigma_m", recording.sigma, columns);
  AddVector("t_s", recording.time, columns);
  AddVector("payload_kg", recording.payload, columns);
}

void AddLabelColumns(const Recording& recording, Columns* columns) {
  AddLabels("anchor", recording.anchor_names, recording.anchor_idx, columns);
  AddLabels("edge", recording.edge_names, recording.edge_idx, columns);
  AddLabels("target", recording.target_names, recording.target_idx, columns);
  AddLabels("run", recording.run_names, recording.run_idx, columns);
  if (!recording.is_test.empty()) {
    columns->push_back({"set", [&recording](int row_idx, CsvText* csv) {
                          csv->Label(recording.test(row_idx) ? "test" : "train");
                        }});
  }
}

Columns ColumnsOf(const Recording& recording, const RobotModel& robot) {
  Columns columns;
  AddMatrix(JointNames("q", "_rad", "_m", robot), recording.q, &columns);
  AddMeasuredColumns(recording, &columns);
  AddLabelColumns(recording, &columns);
  AddJointColumns(recording, robot, &columns);
  for (const ExtraColumn& extra : recording.extra) AddVector(extra.name, extra.values, &columns);
  return columns;
}

}  // namespace

std::string RecordingToCsv(const Recording& recording, const RobotModel& robot) {
  const Columns columns = ColumnsOf(recording, robot);
  CsvText csv;
  for (const Column& column : columns) csv.Label(column.name);
  csv.EndRow();
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    for (const Column& column : columns) column.append(row_idx, &csv);
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace dhcal
