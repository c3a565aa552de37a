#include "core/report/summary_table.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/error_table.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

std::string Count(int count) { return count < 0 ? "-" : std::to_string(count); }

std::string Length(double metres) { return std::isnan(metres) ? "-" : Millimetres(metres); }

/// The fit that the line is about: the best, or else the first that ran.
const FitResult* FitOf(const Result& result) {
  if (result.best() != nullptr) return result.best();
  return result.fits.empty() ? nullptr : &result.fits.front();
}

std::string ShortName(SolverMethod method) {
  return method == SolverMethod::kLevenbergMarquardt ? "LM" : "SVD-GN";
}

std::vector<std::string> Cells(const SummaryRow& row) {
  if (row.result == nullptr) {
    return {row.problem, "-", "-", "-", "-", "-", "-", "-", row.status};
  }
  const FitResult* const fit = FitOf(*row.result);
  const bool usable = row.result->best() != nullptr;
  return {row.problem,
          Count(row.result->rows),
          fit != nullptr && fit->rank >= 0 ? fmt::format("{}/{}", fit->rank, fit->columns) : "-",
          fit != nullptr ? ShortName(fit->solver) : "-",
          Count(fit != nullptr ? fit->iterations : -1),
          Length(ErrorBefore(*row.result)),
          Length(usable ? ErrorAfter(*row.result) : kNotSet),
          Length(InSpace(row.result->kind, row.result->noise_sigma)),
          row.status};
}

}  // namespace

Table SummaryTable(const std::vector<SummaryRow>& rows) {
  Table table;
  table.columns = {{"problem", "", 40, Table::Align::kLeft},
                   {"rows", "", 8},
                   {"rank", "", 9},
                   {"solver", "", 6, Table::Align::kLeft},
                   {"steps", "", 5},
                   {"RMS before", "mm", 10},
                   {"RMS after", "mm", 9},
                   {"noise", "mm", 9},
                   {"status", "", 14, Table::Align::kLeft}};
  for (const SummaryRow& row : rows) table.AddRow(Cells(row));
  return table;
}

}  // namespace dhcal
