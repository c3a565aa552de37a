#include "core/io/cell_table.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "core/base/text.h"
#include "core/io/mat_text.h"
#include "core/io/table_parser.h"
#include "core/io/text_file.h"

namespace dhcal {

SourceLocation CellTable::Where(const Row& row, const char* at) const {
  const char* const line_begin = text_->data() + row.begin;
  const std::string_view before(line_begin, static_cast<std::size_t>(at - line_begin));
  return {file_, row.line, CountCharacters(before) + 1};
}

SourceLocation CellTable::NameWhere(int column_idx) const {
  if (!has_header_) return CellWhere(0, column_idx);
  return Where(header_.row, header_.cells[column_idx].data());
}

SourceLocation CellTable::CellWhere(int row_idx, int column_idx) const {
  return Where(rows_[row_idx], cell(row_idx, column_idx).data());
}

std::optional<CellTable> ParseTable(const std::string& file,
                                    std::string text,
                                    FileErrors* errors,
                                    const SaysUnit& says_unit) {
  return TableParser(file, std::move(text), errors, says_unit).Parse();
}

std::optional<CellTable> ReadTable(const std::string& file,
                                   FileErrors* errors,
                                   const SaysUnit& says_unit) {
  Diagnostics diagnostics;
  std::error_code status;
  if (IsMatFile(file) && std::filesystem::is_regular_file(file, status)) {
    std::optional<std::string> text = MatToText(file, errors);
    if (!text) return std::nullopt;
    return ParseTable(file, std::move(*text), errors, says_unit);
  }
  bool utf16 = false;
  std::optional<std::string> text = ReadTextFile(file, &diagnostics, &utf16);
  for (const Diagnostic& error : diagnostics.all()) errors->Error(error.where, error.message);
  if (!text) return std::nullopt;
  TableParser parser(file, std::move(*text), errors, says_unit);
  if (utf16) parser.AddNote("UTF-16 text");
  return parser.Parse();
}

}  // namespace dhcal
