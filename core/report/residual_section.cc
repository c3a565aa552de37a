// The rows that fit worst, and the notes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/report/format.h"
#include "core/report/sections.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostResiduals = 5;
constexpr std::size_t kMostNotes = 20;

/// Largest standardised coordinate; zero when there is none.
double Sigmas(const RowResidual& row) {
  double largest = 0;
  for (const double value : row.standardised) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Length [m] of the residual without its rotations, which the names call r*.
double Length(const RowResidual& row, const std::vector<std::string>& names) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(row.residual.size()); ++i) {
    const bool rotation = i < static_cast<int>(names.size()) && StartsWith(names[i], "r");
    if (!rotation) sum += row.residual[i] * row.residual[i];
  }
  return std::sqrt(sum);
}

std::vector<const RowResidual*> WorstRows(const std::vector<RowResidual>& rows) {
  std::vector<const RowResidual*> worst;
  worst.reserve(rows.size());
  for (const RowResidual& row : rows) worst.push_back(&row);
  const auto end = worst.begin() + static_cast<long>(std::min(worst.size(), kMostResiduals));
  std::partial_sort(worst.begin(), end, worst.end(), [](const auto* a, const auto* b) {
    const double sigmas_a = Sigmas(*a);
    const double sigmas_b = Sigmas(*b);
    return sigmas_a != sigmas_b ? sigmas_a > sigmas_b : a->row_idx < b->row_idx;
  });
  worst.erase(end, worst.end());
  return worst;
}

}  // namespace

std::string ResidualSection(const Result& result) {
  if (result.best() == nullptr || result.residuals.empty()) return "";
  TextTable table({{"row", ""},
                   {"run", "", 30, TextTable::Align::kLeft},
                   {"set", "", 6, TextTable::Align::kLeft},
                   {"residual", "[mm]"},
                   {"largest coordinate", "[standard deviations]"}});
  for (const RowResidual* const row : WorstRows(result.residuals)) {
    table.AddRow({std::to_string(row->row_idx + 1),
                  row->run.empty() ? "-" : row->run,
                  row->test ? "unseen" : "fitted",
                  Millimetres(Length(*row, result.coordinate_names)),
                  Fixed(Sigmas(*row), 1)});
  }
  return Heading("LARGEST RESIDUALS") + table.ToString();
}

std::string NotesSection(const Result& result) {
  if (result.notes.empty()) return "";
  std::string text = Heading("NOTES");
  for (std::size_t i = 0; i < result.notes.size() && i < kMostNotes; ++i) {
    text += Wrap("  - ", result.notes[i]);
  }
  if (result.notes.size() > kMostNotes) {
    text += Wrap("  ", AndMore(result.notes.size() - kMostNotes));
  }
  return text;
}

}  // namespace dhcal
