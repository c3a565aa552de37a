#include "tools/camera/readings.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/csv_text.h"
#include "core/io/file_errors.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

int ColumnNamed(const CellTable& table, std::string_view name) {
  for (int column = 0; column < table.num_columns(); ++column) {
    if (InLowerCase(table.name(column)) == name) return column;
  }
  return -1;
}

std::vector<double> CoarsePositions(const CellTable& table, int column, FileErrors* errors) {
  std::vector<double> positions;
  for (int row = 0; row < table.num_rows(); ++row) {
    const std::optional<double> number = ParseDouble(table.cell(row, column));
    if (!number) {
      errors->Error(
          table.CellWhere(row, column),
          fmt::format("'{}' is '{}', but a number is expected: where the camera roughly is "
                      "along the ruler [mm]",
                      table.name(column),
                      Printable(table.cell(row, column))));
    }
    positions.push_back(number.value_or(0));
  }
  return positions;
}

std::vector<int> GroupsOf(const CellTable& table) {
  const int run = ColumnNamed(table, "run"), edge = ColumnNamed(table, "edge");
  std::map<std::pair<std::string, std::string>, int> known;
  std::vector<int> groups;
  for (int row = 0; row < table.num_rows(); ++row) {
    const auto text = [&](int column) {
      return column < 0 ? std::string() : std::string(table.cell(row, column));
    };
    const auto next = static_cast<int>(known.size());
    groups.push_back(known.try_emplace({text(run), text(edge)}, next).first->second);
  }
  return groups;
}

void CheckImages(const Readings& readings,
                 const std::vector<std::string>& images,
                 FileErrors* errors) {
  for (int row = 0; row < readings.table.num_rows(); ++row) {
    const std::string_view named = readings.table.cell(row, readings.image);
    const std::string& given = images[static_cast<std::size_t>(row)];
    if (fs::path(std::string(named)).filename() == fs::path(given).filename()) continue;
    errors->Error(
        readings.table.CellWhere(row, readings.image),
        fmt::format("the row is of image '{}', but '{}' stands in its place on the command "
                    "line; give the images in the order of the rows",
                    Printable(named),
                    Printable(given)));
  }
}

/// Errors to where they are collected; the readings where there are none.
std::optional<Readings> Reported(std::optional<Readings> readings,
                                 FileErrors* errors,
                                 Diagnostics* diagnostics) {
  const bool ok = errors->ok();
  errors->Report(diagnostics);
  return ok ? std::move(readings) : std::nullopt;
}

}  // namespace

std::optional<Readings> ReadReadings(const std::string& file,
                                     const std::vector<std::string>& images,
                                     Diagnostics* diagnostics) {
  FileErrors errors(file);
  std::optional<CellTable> table = ReadTable(file, &errors);
  if (!table || !errors.ok()) return Reported(std::nullopt, &errors, diagnostics);
  Readings readings;
  readings.table = std::move(*table);
  if (readings.table.num_rows() != static_cast<int>(images.size())) {
    errors.Error(
        {file},
        fmt::format("has {} rows, but {} images are given; one row for each image, in their "
                    "order, is expected",
                    readings.table.num_rows(),
                    images.size()));
    return Reported(std::nullopt, &errors, diagnostics);
  }
  readings.coarse = ColumnNamed(readings.table, "coarse_mm");
  if (readings.coarse < 0) readings.coarse = ColumnNamed(readings.table, "ruler_mm");
  readings.image = ColumnNamed(readings.table, "image");
  for (const char* const name : {"height1_mm", "height2_mm"}) {
    const int column = ColumnNamed(readings.table, name);
    if (column >= 0) readings.heights.push_back(column);
  }
  if (readings.coarse >= 0) {
    readings.coarse_positions = CoarsePositions(readings.table, readings.coarse, &errors);
  }
  if (readings.image >= 0) CheckImages(readings, images, &errors);
  readings.groups = GroupsOf(readings.table);
  return Reported(std::move(readings), &errors, diagnostics);
}

void CheckReadings(const Readings& readings, const std::string& file, Diagnostics* diagnostics) {
  const auto require = [&](bool there, const std::string& what) {
    if (!there)
      diagnostics->Error({file, 1}, fmt::format("lacks {}, which a recording needs", what));
  };
  require(readings.heights.size() == 2,
          "the columns height1_mm and height2_mm (what the lasers read)");
  require(ColumnNamed(readings.table, "edge") >= 0, "the column edge (the ruler's placement)");
  require(ColumnNamed(readings.table, "q1_deg") >= 0 ||
              ColumnNamed(readings.table, "q1_rad") >= 0 ||
              ColumnNamed(readings.table, "q1_mm") >= 0 || ColumnNamed(readings.table, "q1_m") >= 0,
          "joint coordinates (columns q1_deg ...)");
}

std::string RecordingText(const Readings& readings, const std::vector<double>& ruler) {
  const CellTable& table = readings.table;
  const int replaced = ColumnNamed(table, "ruler_mm");
  std::vector<int> columns;
  for (int column = 0; column < table.num_columns(); ++column) {
    if (column != readings.coarse && column != readings.image && column != replaced) {
      columns.push_back(column);
    }
  }
  CsvText csv;
  for (const int column : columns) csv.Label(table.name(column));
  csv.Label("ruler_mm");
  csv.EndRow();
  for (int row = 0; row < table.num_rows(); ++row) {
    const double place = ruler[static_cast<std::size_t>(row)];
    for (const int column : columns) {
      const bool is_height =
          column == readings.heights.front() || column == readings.heights.back();
      if (is_height && !std::isfinite(place)) {
        csv.Blank();
      } else {
        csv.Label(table.cell(row, column));
      }
    }
    csv.Number(std::round(place * 1e6) / 1e6);
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace dhcal
