#include "core/report/html/figure_csv.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/io/csv_text.h"

namespace dhcal {
namespace {

/// Digits that a drawing has beyond what an eye sees; all digits of the result are in result.json.
constexpr int kCsvDigits = 7;

std::string TitleAndUnit(const Plot::Axis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

/// "before, from above: z [mm] over x [mm]".
std::string PlotName(const Plot& plot) {
  const std::string axes = fmt::format("{} over {}", TitleAndUnit(plot.y), TitleAndUnit(plot.x));
  std::string name = plot.title.empty() ? axes : fmt::format("{}: {}", plot.title, axes);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return name;
}

/// Which columns some series needs.
struct CsvColumns {
  bool names = false, sigma = false, arrows = false;
};

CsvColumns ColumnsOf(const Figure& figure) {
  CsvColumns columns;
  for (const Plot& plot : figure.plots) {
    columns.names = columns.names || !plot.x.names.empty() || !plot.y.names.empty();
    for (const Plot::Series& series : plot.series) {
      columns.sigma = columns.sigma || !series.sigma.empty();
      columns.arrows = columns.arrows || !series.dx.empty();
    }
  }
  return columns;
}

/// A cell that may have no value.
std::string NumberCell(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? fmt::format("{:.{}g}", values[i], kCsvDigits) : std::string();
}

std::string NameAt(const Plot::Axis& axis, double position) {
  const double idx = std::round(position);
  if (idx < 0 || idx >= static_cast<double>(axis.names.size())) return "";
  return axis.names[static_cast<std::size_t>(idx)];
}

void AppendSeries(int number,
                  const Plot& plot,
                  const Plot::Series& series,
                  const CsvColumns& columns,
                  CsvText* csv) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    csv->Integer(number);
    csv->Label(series.name);
    csv->Label(NumberCell(series.x, i));
    csv->Label(NumberCell(series.y, i));
    if (columns.names) {
      csv->Label(NameAt(plot.x, series.x[i]));
      csv->Label(NameAt(plot.y, series.y[i]));
    }
    if (columns.sigma) csv->Label(NumberCell(series.sigma, i));
    if (columns.arrows) {
      csv->Label(NumberCell(series.dx, i));
      csv->Label(NumberCell(series.dy, i));
    }
    csv->EndRow();
  }
}

}  // namespace

std::string FigureCsv(const Figure& figure) {
  const CsvColumns columns = ColumnsOf(figure);
  std::string head;
  CsvText csv;
  for (const char* const name : {"plot", "series", "x", "y"}) csv.Label(name);
  if (columns.names) {
    csv.Label("x_name");
    csv.Label("y_name");
  }
  if (columns.sigma) csv.Label("sigma");
  if (columns.arrows) {
    csv.Label("dx");
    csv.Label("dy");
  }
  csv.EndRow();
  int number = 0;
  for (const Plot& plot : figure.plots) {
    head += fmt::format("# plot {}: {}\n", ++number, PlotName(plot));
    for (const Plot::Series& series : plot.series) {
      AppendSeries(number, plot, series, columns, &csv);
    }
    for (const Plot::Level& level : plot.levels) {
      AppendSeries(number, plot, {level.name, {0}, {level.y}}, columns, &csv);
    }
  }
  return head + csv.Take();
}

}  // namespace dhcal
