// Fills a CellTable line by line.
#ifndef DHCAL_CORE_IO_TABLE_PARSER_H_
#define DHCAL_CORE_IO_TABLE_PARSER_H_

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/file_errors.h"

namespace dhcal {

class TableParser {
 public:
  TableParser(std::string file, std::string text, FileErrors* errors, SaysUnit says_unit);

  /// For the note that says how the table was read.
  void AddNote(std::string what) { notes_.push_back(std::move(what)); }

  std::optional<CellTable> Parse();

 private:
  using Row = CellTable::Row;

  /// What kinds of characters a cell has.
  enum CharacterClass : unsigned char { kUnusual = 1, kBlankInside = 2, kDigit = 4, kEnd = 8 };

  void ClassifyCharacters();
  void ReadLines();
  bool ReadHeader(std::string_view line);
  /// The header out of a comment line, as numpy writes it; or numbers as names.
  void MakeHeader();
  void ReadRow(std::string_view line);
  /// Joins the cells of the row at hand to the names where all that are not blank are units.
  bool JoinUnits();
  /// Whether the row has the header's number of cells, once blank ones at its end are left out.
  bool FitLength();

  /// Splits a line into line_cells_; false after an error.
  bool Split(std::string_view line);
  std::string_view TakePlain(std::string_view* rest);
  /// Takes the quoted cell at the start of `rest` off it; false after an error.
  bool TakeQuoted(std::string_view* rest, std::string_view* cell);
  void MarkUnusual(std::size_t column_idx);

  void ReportLength(std::string_view line);
  std::string LengthCure(bool longer) const;
  /// Names that are missing; a first column that counts the rows needs none.
  void CheckNames();
  bool CountsRows(int column_idx) const;
  void WriteNote();

  CellTable table_;
  FileErrors* errors_;
  SaysUnit says_unit_;
  std::vector<std::string> notes_;
  std::array<unsigned char, 256> class_{};
  Row row_;          // of the line at hand
  Row comment_row_;  // of the last comment
  std::string_view comment_;
  std::vector<std::string_view> line_cells_;
  std::size_t header_extra_ = 0;  // blank names at the header's end, left out
  bool header_reported_ = false;
  std::optional<std::size_t> row_extra_;  // blank cells at each row's end, left out
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_TABLE_PARSER_H_
