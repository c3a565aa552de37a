// The rows that fit worst, and the notes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostResiduals = 5;
constexpr std::size_t kMostNotes = 20;
constexpr std::size_t kMostSetAside = 30;

/// How far a row is off, for comparison; a row of which that is not known comes last.
double Sigmas(const RowResidual& row) { return std::isnan(row.sigmas) ? 0.0 : row.sigmas; }

std::vector<const RowResidual*> WorstRows(const std::vector<RowResidual>& rows) {
  std::vector<const RowResidual*> worst;
  worst.reserve(rows.size());
  for (const RowResidual& row : rows) {
    if (row.set_aside.empty()) worst.push_back(&row);
  }
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

Section SetAsideSection(const Result& result) {
  if (result.rows_set_aside.empty()) return {};
  Table table;
  table.columns = {{"row", ""},
                   {"set", "", 6, Table::Align::kLeft},
                   {"off by", "mm"},
                   {"what is odd", "", 60, Table::Align::kLeft}};
  for (const RowSetAside& row : result.rows_set_aside) {
    if (table.rows.size() == kMostSetAside) break;
    table.AddRow({std::to_string(row.row_idx + 1),
                  row.test ? "unseen" : "fitted",
                  std::isnan(row.size) ? "-" : Millimetres(row.size),
                  row.reason});
  }
  if (result.rows_set_aside.size() > kMostSetAside) {
    table.AddLeftOut(result.rows_set_aside.size() - kMostSetAside);
  }
  return {"EXCLUDED ROWS",
          {Paragraph{{"These rows do not fit any model of the others: they are neither fitted nor "
                      "tested with. Check how they were taken."},
                     ""},
           table}};
}

Section ResidualSection(const Result& result) {
  if (result.best() == nullptr || result.residuals.empty()) return {};
  Table table;
  table.columns = {{"row", ""},
                   {"run", "", 30, Table::Align::kLeft},
                   {"set", "", 6, Table::Align::kLeft},
                   {"residual", "mm"},
                   {"largest coordinate", "standard deviations"}};
  for (const RowResidual* const row : WorstRows(result.residuals)) {
    table.AddRow({std::to_string(row->row_idx + 1),
                  row->run.empty() ? "-" : row->run,
                  row->test ? "unseen" : "fitted",
                  Millimetres(row->length),
                  Fixed(row->sigmas, 1)});
  }
  return {"LARGEST RESIDUALS", {table}};
}

Section NotesSection(const Result& result) {
  if (result.notes.empty()) return {};
  List notes;
  notes.kind = List::Kind::kBullets;
  for (const std::string& note : result.notes) {
    if (notes.items.size() == kMostNotes) break;
    notes.items.push_back({note, "", {}});
  }
  notes.left_out = result.notes.size() - notes.items.size();
  return {"NOTES", {notes}};
}

}  // namespace dhcal
