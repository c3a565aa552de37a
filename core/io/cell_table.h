// Reads a text table: a header, then rows of as many cells, each with its place. Separators, number
// spellings and encodings are taken as they come where they can mean only one thing.
// The libraries at hand either give no places or depend on the locale.
#ifndef DHCAL_CORE_IO_CELL_TABLE_H_
#define DHCAL_CORE_IO_CELL_TABLE_H_

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/io/file_errors.h"
#include "core/io/table_format.h"

namespace dhcal {

/// Why the numbers of a column cannot be told, and what to do.
struct TableDoubt {
  int row_idx = 0;      // a cell that shows it
  std::string message;  // "" = no doubt
};

/// Cells as text, without the quotes and blanks around them; numbers are plain ("-2392.6452"),
/// words for blanks ("NaN") are blank. Comments and lines without content are left out.
class CellTable {
 public:
  int num_columns() const { return static_cast<int>(header_.cells.size()); }
  int num_rows() const { return static_cast<int>(rows_.size()); }

  /// False when the first row holds numbers; names are then "1", "2" ...
  bool has_header() const { return has_header_; }
  /// As the header's own line says it.
  std::string_view own_name(int column_idx) const { return header_.cells[column_idx]; }
  /// With its unit, where a second line has it. May be blank for a first column that merely counts
  /// the rows.
  std::string_view name(int column_idx) const {
    return joined_.empty() ? header_.cells[column_idx] : std::string_view(joined_[column_idx]);
  }
  std::string_view cell(int row_idx, int column_idx) const {
    return cells_[CellIndex(row_idx, column_idx)];
  }
  const TableDoubt& doubt(int column_idx) const { return doubts_[column_idx]; }
  const TableFormat& format() const { return format_; }

  int line(int row_idx) const { return rows_[row_idx].line; }
  SourceLocation NameWhere(int column_idx) const;
  SourceLocation CellWhere(int row_idx, int column_idx) const;

 private:
  friend class TableParser;
  friend class TableNumbers;

  struct Row {
    int line = 0;
    std::size_t begin = 0;  // offset of the line in the text
  };
  struct Header {
    Row row;
    std::vector<std::string_view> cells;
  };

  std::size_t CellIndex(int row_idx, int column_idx) const {
    return static_cast<std::size_t>(row_idx) * header_.cells.size() + column_idx;
  }
  SourceLocation Where(const Row& row, const char* at) const;

  std::string file_;
  TableFormat format_;
  std::unique_ptr<std::string> text_;  // what the cells point into
  bool has_header_ = true;
  std::vector<std::string> numbers_;  // the names of columns without a header
  Header header_;
  std::vector<std::string> joined_;  // the names with the units of a second line; empty = none
  std::vector<Row> rows_;
  std::vector<std::string_view> cells_;  // row by row
  std::vector<bool> unusual_;            // columns with cells other than plain numbers
  std::vector<TableDoubt> doubts_;       // one per column
};

/// True for a cell that says a unit. A first row of nothing else is a second line of the header,
/// and its units are joined to the names: "x [mm]".
using SaysUnit = std::function<bool(std::string_view)>;

/// The table without the rows whose number of cells is wrong, or nothing when there is no row.
/// `errors` says what is wrong, and one note what was taken otherwise than as commas and points.
std::optional<CellTable> ReadTable(const std::string& file,
                                   FileErrors* errors,
                                   const SaysUnit& says_unit = {});

/// The same from text that is in memory.
std::optional<CellTable> ParseTable(const std::string& file,
                                    std::string text,
                                    FileErrors* errors,
                                    const SaysUnit& says_unit = {});

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_CELL_TABLE_H_
