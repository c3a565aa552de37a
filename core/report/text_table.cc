#include "core/report/text_table.h"

#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

constexpr int kIndent = 2;
constexpr int kGap = 2;

std::string Spaces(int count) {
  return std::string(static_cast<std::size_t>(std::max(0, count)), ' ');
}

std::string WithoutTrailingSpaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
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

}  // namespace

void TextTable::AddLine(std::string text) { rows_.push_back({std::move(text)}); }

void TextTable::AlignPoints() {
  constexpr int kMostExtraWidth = 2;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    if (columns_[j].align != Align::kPoint) continue;
    int before = 0;
    int after = 0;
    for (const std::vector<std::string>& row : rows_) {
      if (row.size() == 1 || !IsPlainNumber(row[j])) continue;
      const int length = LengthFromPoint(row[j]);
      after = std::max(after, length);
      before = std::max(before, static_cast<int>(row[j].size()) - length);
    }
    if (before + after > columns_[j].max_width + kMostExtraWidth) continue;
    columns_[j].max_width = std::max(columns_[j].max_width, before + after);
    for (std::vector<std::string>& row : rows_) {
      if (row.size() == 1 || !IsPlainNumber(row[j])) continue;
      row[j] += Spaces(after - LengthFromPoint(row[j]));
    }
  }
}

std::vector<int> TextTable::Widths() const {
  constexpr int kNarrowest = 8;
  std::vector<int> widths;
  int total = kIndent;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Column& column = columns_[j];
    int width = std::max(CountCharacters(column.title), CountCharacters(column.unit));
    width = std::max(width, column.min_width);
    for (const std::vector<std::string>& row : rows_) {
      if (row.size() == 1 && columns_.size() > 1) continue;
      width = std::max(width, std::min(CountCharacters(row[j]), column.max_width));
    }
    widths.push_back(width);
    total += width + (j > 0 ? kGap : 0);
  }
  const int excess = std::max(0, total - kReportWidth);
  widths[0] = std::max(std::min(widths[0], kNarrowest), widths[0] - excess);
  return widths;
}

std::string TextTable::RowToString(const std::vector<std::string>& cells,
                                   const std::vector<int>& widths) const {
  std::string line = Spaces(kIndent);
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    if (j > 0) line += Spaces(kGap);
    const std::string cell = Clip(cells[j], widths[j]);
    const std::string fill = Spaces(widths[j] - CountCharacters(cell));
    line += columns_[j].align == Align::kLeft ? cell + fill : fill + cell;
  }
  return WithoutTrailingSpaces(line) + "\n";
}

std::string TextTable::ToString() {
  AlignPoints();
  const std::vector<int> widths = Widths();
  std::vector<std::string> titles, units;
  bool has_units = false;
  for (const Column& column : columns_) {
    titles.push_back(column.title);
    units.push_back(column.unit);
    has_units = has_units || !column.unit.empty();
  }
  std::string text = RowToString(titles, widths);
  if (has_units) text += RowToString(units, widths);
  for (const std::vector<std::string>& row : rows_) {
    const bool across = row.size() == 1 && columns_.size() > 1;
    text += across ? Wrap(Spaces(kIndent), row[0]) : RowToString(row, widths);
  }
  return text;
}

}  // namespace dhcal
