#include "core/io/csv.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/text_file.h"

namespace dhcal {

namespace {

/// A line without any content; spreadsheets write blank lines as commas alone.
bool IsBlankLine(std::string_view line) {
  return line.find_first_not_of(", \t") == std::string_view::npos;
}

}  // namespace

SourceLocation CsvTable::Where(const Row& row, const char* at) const {
  const char* const line_begin = text_->data() + row.begin;
  const std::string_view before(line_begin, static_cast<std::size_t>(at - line_begin));
  return {file_, row.line, CountCharacters(before) + 1};
}

SourceLocation CsvTable::NameWhere(int column_idx) const {
  return Where(header_.row, name(column_idx).data());
}

SourceLocation CsvTable::CellWhere(int row_idx, int column_idx) const {
  return Where(rows_[row_idx], cell(row_idx, column_idx).data());
}

/// Fills a CsvTable line by line.
class CsvParser {
 public:
  CsvParser(std::string file, std::string text, FileErrors* errors) : errors_(errors) {
    table_.file_ = std::move(file);
    table_.text_ = std::make_unique<std::string>(std::move(text));
  }

  std::optional<CsvTable> Parse();

 private:
  using Row = CsvTable::Row;

  /// The next line without its end, "\n", "\r\n" or "\r"; false at the end of the text.
  bool NextLine(std::string_view* line);
  bool ReadHeader(const Row& row, std::string_view line);
  void ReadRow(const Row& row, std::string_view line);
  /// Splits a line into line_cells_; false after an error.
  bool Split(const Row& row, std::string_view line);
  /// Takes the quoted cell at the start of `rest` off it; false after an error.
  bool TakeQuoted(const Row& row, std::string_view* rest, std::string_view* cell);
  void ReportLength(const Row& row, std::string_view line);

  CsvTable table_;
  FileErrors* errors_;
  std::size_t position_ = 0;
  Row row_;
  std::vector<std::string_view> line_cells_;
};

bool CsvParser::NextLine(std::string_view* line) {
  const std::string_view text = *table_.text_;
  if (position_ >= text.size()) return false;
  // Several times quicker than find_first_of, which searches the set for each character.
  std::size_t end = position_;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
  *line = text.substr(position_, end - position_);
  ++row_.line;
  row_.begin = position_;
  position_ = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  return true;
}

bool CsvParser::TakeQuoted(const Row& row, std::string_view* rest, std::string_view* cell) {
  // A doubled quote stands for one: the cell is closed up in place, blanks fill the gap, so that
  // places in the line stay right.
  char* const begin = table_.text_->data() + (rest->data() - table_.text_->data()) + 1;
  const char* const end = rest->data() + rest->size();
  char* write = begin;
  const char* read = begin;
  while (read != end && (*read != '"' || (read + 1 != end && read[1] == '"'))) {
    if (*read == '"') ++read;
    *write++ = *read++;
  }
  if (read == end) {
    errors_->Error(table_.Where(row, begin - 1),
                   "the quote that opens here is not closed in its line");
    return false;
  }
  *cell = std::string_view(begin, static_cast<std::size_t>(write - begin));
  std::fill(write, begin + (read - begin), ' ');
  ++read;
  while (read != end && (*read == ' ' || *read == '\t')) ++read;
  if (read != end && *read != ',') {
    errors_->Error(table_.Where(row, read), "after the closing quote a comma is expected");
    return false;
  }
  *rest = std::string_view(read, static_cast<std::size_t>(end - read));
  return true;
}

bool CsvParser::Split(const Row& row, std::string_view line) {
  line_cells_.clear();
  std::string_view rest = line;
  while (true) {
    std::size_t first = 0;
    while (first < rest.size() && (rest[first] == ' ' || rest[first] == '\t')) ++first;
    std::string_view cell;
    if (first < rest.size() && rest[first] == '"') {
      rest.remove_prefix(first);
      if (!TakeQuoted(row, &rest, &cell)) return false;
    } else {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      cell = Trim(rest.substr(0, comma));
      rest.remove_prefix(comma);
    }
    line_cells_.push_back(cell);
    if (rest.empty()) return true;
    rest.remove_prefix(1);
  }
}

bool CsvParser::ReadHeader(const Row& row, std::string_view line) {
  const auto commas = std::count(line.begin(), line.end(), ',');
  for (const auto& [separator, words] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")}) {
    if (std::count(line.begin(), line.end(), separator) <= commas) continue;
    errors_->Error(table_.Where(row, line.data() + line.find(separator)),
                   fmt::format("the cells are separated by {}; save the file with commas between "
                               "cells and with decimal points",
                               words));
    return false;
  }
  if (!Split(row, line)) return false;
  table_.header_ = {row, line_cells_};
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (!table_.name(i).empty()) continue;
    const bool last = i + 1 == table_.num_columns();
    errors_->Error(table_.NameWhere(i),
                   fmt::format("column {} of the header has no name; {}, or name the column",
                               i + 1,
                               last ? "delete the comma at the end of the header and of the rows"
                                    : "delete the column"));
  }
  return true;
}

void CsvParser::ReportLength(const Row& row, std::string_view line) {
  const std::size_t expected = table_.header_.cells.size();
  const bool longer = line_cells_.size() > expected;
  const char* const at = longer ? line_cells_[expected].data() : line.data() + line.size();
  errors_->Error(
      table_.Where(row, at),
      fmt::format("the row has {} cells, but the header has {}{}",
                  line_cells_.size(),
                  expected,
                  longer ? "; are numbers written with decimal commas? Use decimal points"
                         : "; write blank cells as ',,'"));
}

void CsvParser::ReadRow(const Row& row, std::string_view line) {
  if (!Split(row, line)) return;
  if (line_cells_.size() != table_.header_.cells.size()) {
    ReportLength(row, line);
    return;
  }
  table_.rows_.push_back(row);
  table_.cells_.insert(table_.cells_.end(), line_cells_.begin(), line_cells_.end());
}

std::optional<CsvTable> CsvParser::Parse() {
  bool have_header = false;
  std::string_view line;
  while (NextLine(&line)) {
    const std::string_view content = Trim(line);
    if (IsBlankLine(content) || content[0] == '#') continue;
    if (have_header) {
      ReadRow(row_, line);
    } else if (ReadHeader(row_, line)) {
      have_header = true;
    } else {
      return std::nullopt;
    }
  }
  if (!have_header) {
    errors_->Error({table_.file_}, "the recording is empty: a header and rows are expected");
    return std::nullopt;
  }
  if (table_.num_rows() == 0) {
    if (errors_->ok()) {
      errors_->Error(table_.NameWhere(0), "the recording has a header, but no row below it");
    }
    return std::nullopt;
  }
  return std::move(table_);
}

std::optional<CsvTable> ReadCsv(const std::string& file, FileErrors* errors) {
  Diagnostics diagnostics;
  std::optional<std::string> text = ReadTextFile(file, &diagnostics);
  for (const Diagnostic& error : diagnostics.all()) errors->Error(error.where, error.message);
  if (!text) return std::nullopt;
  return CsvParser(file, std::move(*text), errors).Parse();
}

}  // namespace dhcal
