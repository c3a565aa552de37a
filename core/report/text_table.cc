#include "core/report/text_table.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/report/format.h"
#include "core/report/text_layout.h"

namespace dhcal {
namespace {

constexpr int kGap = 2;
constexpr int kNarrowest = 8;       // of the column that gives way
constexpr int kMostExtraWidth = 2;  // that aligned points may take beyond a column's own

std::string WithoutTrailingSpaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/// "[mm]"
std::string InBrackets(const std::string& unit) {
  return unit.empty() ? "" : fmt::format("[{}]", unit);
}

/// Characters from the decimal point on; a number without one counts as ending before it.
int LengthFromPoint(const std::string& cell) {
  const std::size_t point = cell.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(cell.size() - point);
}

/// Scientific numbers and words have no place in line with decimal points.
bool IsPlainNumber(const std::string& cell) {
  return cell.find_first_not_of("+-.0123456789") == std::string::npos && cell != "-";
}

/// Fills the plain numbers of column `j` up on their right, so that their points stand in line when
/// the cells do on the right. Returns how wide the column must be; its own width where they find no
/// room.
int AlignPoints(std::size_t j, int max_width, std::vector<Table::Row>* rows) {
  int before = 0;
  int after = 0;
  for (const Table::Row& row : *rows) {
    if (row.cells.empty() || !IsPlainNumber(row.cells[j])) continue;
    const int length = LengthFromPoint(row.cells[j]);
    after = std::max(after, length);
    before = std::max(before, static_cast<int>(row.cells[j].size()) - length);
  }
  if (before + after > max_width + kMostExtraWidth) return max_width;
  for (Table::Row& row : *rows) {
    if (row.cells.empty() || !IsPlainNumber(row.cells[j])) continue;
    row.cells[j] += Spaces(after - LengthFromPoint(row.cells[j]));
  }
  return std::max(max_width, before + after);
}

/// Cells with their points in line, and the width of each column.
struct Layout {
  std::vector<Table::Row> rows;
  std::vector<int> widths;
};

Layout LayOut(const Table& table) {
  Layout layout;
  layout.rows = table.rows;
  int total = kTextIndent;
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    const Table::Column& column = table.columns[j];
    const int most = column.align == Table::Align::kPoint
                         ? AlignPoints(j, column.max_width, &layout.rows)
                         : column.max_width;
    int width = std::max(CountCharacters(column.title), CountCharacters(InBrackets(column.unit)));
    for (const Table::Row& row : layout.rows) {
      if (row.cells.empty()) continue;
      width = std::max(width, std::min(CountCharacters(row.cells[j]), most));
    }
    layout.widths.push_back(width);
    total += width + (j > 0 ? kGap : 0);
  }
  if (layout.widths.empty()) return layout;
  const int excess = std::max(0, total - kReportWidth);
  int& first = layout.widths.front();
  first = std::max(std::min(first, kNarrowest), first - excess);
  return layout;
}

std::string Line(const std::vector<Table::Column>& columns,
                 const std::vector<int>& widths,
                 const std::vector<std::string>& cells) {
  std::string line = Spaces(kTextIndent);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (j > 0) line += Spaces(kGap);
    const std::string cell = Clip(cells[j], widths[j]);
    const std::string fill = Spaces(widths[j] - CountCharacters(cell));
    line += columns[j].align == Table::Align::kLeft ? cell + fill : fill + cell;
  }
  return WithoutTrailingSpaces(line) + "\n";
}

std::string Heading(const Table& table, const std::vector<int>& widths) {
  std::vector<std::string> titles, units;
  bool has_units = false;
  for (const Table::Column& column : table.columns) {
    titles.push_back(column.title);
    units.push_back(InBrackets(column.unit));
    has_units = has_units || !column.unit.empty();
  }
  return Line(table.columns, widths, titles) +
         (has_units ? Line(table.columns, widths, units) : std::string());
}

}  // namespace

std::string ToText(const Table& table) {
  const Layout layout = LayOut(table);
  std::string text;
  if (!table.title.empty()) text += Wrap(Spaces(kTextIndent), table.title);
  text += Heading(table, layout.widths);
  for (const Table::Row& row : layout.rows) {
    text += row.cells.empty() ? Wrap(Spaces(kTextIndent), AndMore(row.left_out))
                              : Line(table.columns, layout.widths, row.cells);
  }
  return text;
}

}  // namespace dhcal
