// Makes the numbers of a table plain: decimal points, no thousands separators, blanks blank.
#ifndef DHCAL_CORE_IO_TABLE_NUMBERS_H_
#define DHCAL_CORE_IO_TABLE_NUMBERS_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/number_text.h"

namespace dhcal {

/// Works column by column. A column's own cells tell its decimal mark, as "0,5" or "1,234.5" do;
/// where they leave it open ("1,234"), the other columns must agree on one.
class TableNumbers {
 public:
  explicit TableNumbers(CellTable* table) : table_(*table) {}

  /// Rewrites the cells; what cannot be told is left as it is and named in the table's doubts.
  /// Returns what was done, in words for "read with ...".
  std::vector<std::string> MakePlain();

 private:
  /// What the cells of a column show.
  struct Evidence {
    bool point = false;  // some cell can only have a decimal point
    bool comma = false;
    int open_row = -1;        // the first cell that may be either
    bool open_point = false;  // some such cell holds a point
    bool open_comma = false;
  };

  Evidence LookAt(int column_idx);
  void Decide(int column_idx, const Evidence& evidence, bool file_point, bool file_comma);
  void Rewrite(int column_idx, char mark);
  void RewriteCell(std::string_view* cell, char mark, const NumberForm& form);
  std::string Doubt(int row_idx, int column_idx) const;

  CellTable& table_;
  std::vector<std::string> blank_words_;
  std::string groups_;
  bool decimal_commas_ = false, odd_minus_ = false;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_TABLE_NUMBERS_H_
