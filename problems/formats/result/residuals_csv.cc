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

/// Which columns there are besides those of every recording.
struct Extras {
  bool target = false, effects = false, set_aside = false;
};

void AppendHeader(const std::vector<Coordinate>& coordinates, const Extras& extras, CsvText* csv) {
  csv->Label("row");
  csv->Label("run");
  if (extras.target) csv->Label("target");
  csv->Label("set");
  for (const Coordinate& coordinate : coordinates) {
    for (const char* const what : {"measured_", "predicted_before_", "predicted_after_"}) {
      csv->Label(what + coordinate.suffix);
    }
    if (extras.effects) csv->Label("predicted_effects_" + coordinate.suffix);
    csv->Label("residual_" + coordinate.suffix);
    csv->Label("standardised_" + coordinate.name);
  }
  csv->Label("leverage");
  if (extras.set_aside) csv->Label("set_aside");
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

void AppendRow(const RowResidual& row,
               const std::vector<Coordinate>& coordinates,
               const Extras& extras,
               CsvText* csv) {
  for (int i = 0; i < static_cast<int>(coordinates.size()); ++i) {
    const double unit = coordinates[i].unit;
    AppendElement(row.measured, i, unit, csv);
    AppendElement(row.predicted_before, i, unit, csv);
    AppendElement(row.predicted_after, i, unit, csv);
    if (extras.effects) AppendElement(row.predicted_effects, i, unit, csv);
    AppendElement(row.residual, i, unit, csv);
    AppendElement(row.standardised, i, 1.0, csv);
  }
  csv->Number(row.leverage);
  if (extras.set_aside) csv->Label(row.set_aside);
  csv->EndRow();
}

}  // namespace

std::string ResidualsToCsv(const Result& result, const Recording& recording) {
  const std::vector<Coordinate> coordinates = CoordinatesOf(result);
  const Extras extras = {
      !recording.target_idx.empty(), result.delivered.has_value(), !result.rows_set_aside.empty()};
  CsvText csv;
  AppendHeader(coordinates, extras, &csv);
  for (const RowResidual& row : result.residuals) {
    csv.Integer(row.row_idx + 1);
    csv.Label(row.run);
    if (extras.target) csv.Label(recording.target_names[recording.target(row.row_idx)]);
    csv.Label(row.test ? "test" : "train");
    AppendRow(row, coordinates, extras, &csv);
  }
  return csv.Take();
}

}  // namespace dhcal
