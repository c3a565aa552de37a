// Reads comma separated values: a header, then rows of as many cells, each with its place.
// The libraries at hand either give no places or depend on the locale.
#ifndef DHCAL_CORE_IO_CSV_H_
#define DHCAL_CORE_IO_CSV_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/io/file_errors.h"

namespace dhcal {

/// Cells as text, without the quotes and blanks around them. Lines that start with '#' and lines of
/// nothing but blanks and commas are left out.
class CsvTable {
 public:
  int num_columns() const { return static_cast<int>(header_.cells.size()); }
  int num_rows() const { return static_cast<int>(rows_.size()); }

  std::string_view name(int column_idx) const { return header_.cells[column_idx]; }
  std::string_view cell(int row_idx, int column_idx) const {
    return cells_[static_cast<std::size_t>(row_idx) * header_.cells.size() + column_idx];
  }

  int line(int row_idx) const { return rows_[row_idx].line; }
  SourceLocation NameWhere(int column_idx) const;
  SourceLocation CellWhere(int row_idx, int column_idx) const;

 private:
  friend class CsvParser;

  struct Row {
    int line = 0;
    std::size_t begin = 0;  // offset of the line in the text
  };
  struct Header {
    Row row;
    std::vector<std::string_view> cells;
  };

  SourceLocation Where(const Row& row, const char* at) const;

  std::string file_;
  std::unique_ptr<std::string> text_;  // what the cells point into
  Header header_;
  std::vector<Row> rows_;
  std::vector<std::string_view> cells_;  // row by row
};

/// The table without the rows whose number of cells is wrong, or nothing when there is no header
/// or no row. `errors` says what is wrong.
std::optional<CsvTable> ReadCsv(const std::string& file, FileErrors* errors);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_CSV_H_
