// A table of a text report: columns as wide as their cells need. When that is more than the
// report is wide, the first column gives way.
#ifndef DHCAL_CORE_REPORT_TEXT_TABLE_H_
#define DHCAL_CORE_REPORT_TEXT_TABLE_H_

#include <string>
#include <utility>
#include <vector>

namespace dhcal {

class TextTable {
 public:
  enum class Align {
    kLeft,
    kRight,
    kPoint,  // decimal points one under the other, as far as the width allows
  };

  struct Column {
    std::string title;
    std::string unit;    // second line of the heading
    int max_width = 12;  // [characters] a longer cell loses its middle
    Align align = Align::kRight;
    int min_width = 0;  // for tables that shall look alike one under the other
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// One cell per column.
  void AddRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// A line of text across the columns.
  void AddLine(std::string text);

  /// Heading and rows, indented by two.
  std::string ToString();

 private:
  void AlignPoints();
  std::vector<int> Widths() const;
  std::string RowToString(const std::vector<std::string>& cells,
                          const std::vector<int>& widths) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  // one cell = a line across the columns
};

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_TEXT_TABLE_H_
