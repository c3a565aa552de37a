// residuals.csv: what was measured, what was predicted and what is left, row by row.
#include <string>

#include "core/base/units.h"
#include "core/io/csv_text.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

struct Coordinate {
  std::string name;
  std::string suffix;  // "x_mm"
  double unit = 1;     // [SI per printed unit]
};

bool IsRotation(const std::string& name) { return name == "rx" || name == "ry" || name == "rz"; }

std::vector<Coordinate> CoordinatesOf(const Result& result) {
  std::vector<Coordinate> coordinates;
  for (const std::string& name : result.coordinate_names) {
    const bool rotation = IsRotation(name);
    coordinates.push_back(
        {name, name + (rotation ? "_mrad" : "_mm"), rotation ? kMilliradian : kMillimetre});
  }
  return coordinates;
}

void AppendHeader(const std::vector<Coordinate>& coordinates, bool with_target, CsvText* csv) {
  csv->Label("row");
  csv->Label("run");
  if (with_target) csv->Label("target");
  csv->Label("set");
  for (const Coordinate& coordinate : coordinates) {
    for (const char* const what :
         {"measured_", "predicted_before_", "predicted_after_", "residual_"}) {
      csv->Label(what + coordinate.suffix);
    }
    csv->Label("standardised_" + coordinate.name);
  }
  csv->Label("leverage");
  csv->EndRow();
}

/// Blank when the vector was not computed.
void AppendElement(const Eigen::VectorXd& vector, int index, double unit, CsvText* csv) {
  if (index < vector.size()) {
    csv->Number(vector[index] / unit);
  } else {
    csv->Blank();
  }
}

void AppendRow(const RowResidual& row, const std::vector<Coordinate>& coordinates, CsvText* csv) {
  for (int i = 0; i < static_cast<int>(coordinates.size()); ++i) {
    const double unit = coordinates[i].unit;
    AppendElement(row.measured, i, unit, csv);
    AppendElement(row.predicted_before, i, unit, csv);
    AppendElement(row.predicted_after, i, unit, csv);
    AppendElement(row.residual, i, unit, csv);
    AppendElement(row.standardised, i, 1.0, csv);
  }
  csv->Number(row.leverage);
  csv->EndRow();
}

}  // namespace

std::string ResidualsToCsv(const Result& result, const Recording& recording) {
  const std::vector<Coordinate> coordinates = CoordinatesOf(result);
  const bool with_target = !recording.target_idx.empty();
  CsvText csv;
  AppendHeader(coordinates, with_target, &csv);
  for (const RowResidual& row : result.residuals) {
    csv.Integer(row.row_idx + 1);
    csv.Label(row.run);
    if (with_target) csv.Label(recording.target_names[recording.target(row.row_idx)]);
    csv.Label(row.test ? "test" : "train");
    AppendRow(row, coordinates, &csv);
  }
  return csv.Take();
}

}  // namespace dhcal
