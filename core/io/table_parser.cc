#include "core/io/table_parser.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/number_text.h"
#include "core/io/table_numbers.h"

namespace dhcal {

namespace {

bool IsNumberOrBlank(std::string_view cell) {
  return cell.empty() || IsNumberText(cell) || IsBlankWord(cell);
}

/// A row of numbers where names should stand.
bool HoldsNumbers(const std::vector<std::string_view>& cells) {
  const bool any =
      std::any_of(cells.begin(), cells.end(), [](std::string_view c) { return IsNumberText(c); });
  return any && std::all_of(cells.begin(), cells.end(), IsNumberOrBlank);
}

/// A comment without the signs at its start.
std::string_view WithoutSigns(std::string_view comment) {
  while (!comment.empty() && (comment.front() == '#' || comment.front() == ' ')) {
    comment.remove_prefix(1);
  }
  return comment;
}

/// "[mm]" or "(mm)" as "mm".
std::string_view WithoutBrackets(std::string_view cell) {
  const bool bracketed = cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') ||
                                             (cell.front() == '(' && cell.back() == ')'));
  return bracketed ? Trim(cell.substr(1, cell.size() - 2)) : cell;
}

}  // namespace

TableParser::TableParser(std::string file, std::string text, FileErrors* errors, SaysUnit says_unit)
    : errors_(errors), says_unit_(std::move(says_unit)) {
  table_.file_ = std::move(file);
  table_.text_ = std::make_unique<std::string>(std::move(text));
  table_.format_ = GuessFormat(*table_.text_);
  ClassifyCharacters();
}

void TableParser::ClassifyCharacters() {
  class_.fill(kUnusual);
  for (const char c : std::string_view("+-.eE")) class_[static_cast<unsigned char>(c)] = 0;
  for (char c = '0'; c <= '9'; ++c) class_[static_cast<unsigned char>(c)] = kDigit;
  class_[' '] = kBlankInside;
  class_['\t'] = kBlankInside;
  if (table_.format_.blanks()) class_['\t'] = kEnd;
  class_[static_cast<unsigned char>(table_.format_.separator)] = kEnd;
}

void TableParser::MarkUnusual(std::size_t column_idx) {
  if (column_idx >= table_.unusual_.size()) table_.unusual_.resize(column_idx + 1, false);
  table_.unusual_[column_idx] = true;
}

std::string_view TableParser::TakePlain(std::string_view* rest) {
  unsigned char seen = 0;
  std::size_t end = 0;
  for (; end < rest->size(); ++end) {
    const unsigned char kind = class_[static_cast<unsigned char>((*rest)[end])];
    if (kind == kEnd) break;
    seen = static_cast<unsigned char>(seen | kind);
  }
  const std::string_view cell = Trim(rest->substr(0, end));
  rest->remove_prefix(end);
  const bool blank_inside =
      (seen & kBlankInside) != 0 && cell.find_first_of(" \t") != std::string_view::npos;
  const bool plain = (seen & kUnusual) == 0 && (seen & kDigit) != 0 && !blank_inside;
  if (!plain && !cell.empty()) MarkUnusual(line_cells_.size());
  return cell;
}

bool TableParser::TakeQuoted(std::string_view* rest, std::string_view* cell) {
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
    errors_->Error(table_.Where(row_, begin - 1),
                   "the quote that opens here is not closed in its line");
    return false;
  }
  *cell = std::string_view(begin, static_cast<std::size_t>(write - begin));
  std::fill(write, begin + (read - begin), ' ');
  MarkUnusual(line_cells_.size());
  ++read;
  const auto is_end = [&](char c) { return class_[static_cast<unsigned char>(c)] == kEnd; };
  while (read != end && (*read == ' ' || *read == '\t') && !is_end(*read)) ++read;
  if (read != end && !is_end(*read)) {
    errors_->Error(table_.Where(row_, read),
                   fmt::format("after the closing quote a {} is expected", table_.format_.Word()));
    return false;
  }
  *rest = std::string_view(read, static_cast<std::size_t>(end - read));
  return true;
}

bool TableParser::Split(std::string_view line) {
  line_cells_.clear();
  const bool blanks = table_.format_.blanks();
  std::string_view rest = blanks ? Trim(line) : line;
  while (true) {
    std::size_t first = 0;
    while (first < rest.size() && class_[static_cast<unsigned char>(rest[first])] == kBlankInside) {
      ++first;
    }
    std::string_view cell;
    if (first < rest.size() && rest[first] == '"') {
      rest.remove_prefix(first);
      if (!TakeQuoted(&rest, &cell)) return false;
    } else {
      cell = TakePlain(&rest);
    }
    line_cells_.push_back(cell);
    if (rest.empty()) return true;
    rest.remove_prefix(1);
    if (blanks) rest = Trim(rest);
  }
}

bool TableParser::ReadHeader(std::string_view line) {
  // The header's own cells say nothing of the columns' numbers.
  if (!Split(line)) return false;
  table_.unusual_.clear();
  if (table_.format_.blanks()) line_cells_ = CellsOf(line, table_.format_);
  while (line_cells_.size() > 1 && line_cells_.back().empty()) {
    line_cells_.pop_back();
    ++header_extra_;
  }
  if (HoldsNumbers(line_cells_)) {
    MakeHeader();
    ReadRow(line);
  } else {
    table_.header_ = {row_, line_cells_};
  }
  return true;
}

void TableParser::MakeHeader() {
  const std::size_t expected = line_cells_.size();
  header_extra_ = 0;
  const std::vector<std::string_view> names = CellsOf(WithoutSigns(comment_), table_.format_);
  if (!comment_.empty() && names.size() == expected &&
      std::none_of(names.begin(), names.end(), IsNumberOrBlank)) {
    table_.header_ = {comment_row_, names};
    AddNote(fmt::format("the names of columns from the comment in line {}", comment_row_.line));
    return;
  }
  table_.has_header_ = false;
  table_.header_.row = row_;
  for (std::size_t i = 0; i < expected; ++i) table_.numbers_.push_back(std::to_string(i + 1));
  for (const std::string& number : table_.numbers_) table_.header_.cells.emplace_back(number);
}

bool TableParser::FitLength() {
  const std::size_t expected = table_.header_.cells.size();
  if (line_cells_.size() == expected && row_extra_ == std::size_t{0}) return true;
  if (line_cells_.size() < expected) return false;
  const bool blank = std::all_of(line_cells_.begin() + static_cast<std::ptrdiff_t>(expected),
                                 line_cells_.end(),
                                 [](std::string_view cell) { return cell.empty(); });
  const std::size_t extra = line_cells_.size() - expected;
  // The first row sets the number: later, a blank cell too many is a separator mistyped.
  if (!blank || extra != row_extra_.value_or(extra)) return false;
  row_extra_ = extra;
  line_cells_.resize(expected);
  return true;
}

std::string TableParser::LengthCure(bool longer) const {
  if (longer && table_.format_.separator == ',') {
    return "are numbers written with decimal commas? Use decimal points";
  }
  if (longer) return fmt::format("delete the {} too many", table_.format_.Word());
  if (table_.format_.blanks()) return "write NaN where nothing was measured";
  const std::string separator =
      table_.format_.separator == '\t' ? "<tab>" : std::string(1, table_.format_.separator);
  return fmt::format("write blank cells as '{0}{0}'", separator);
}

void TableParser::ReportLength(std::string_view line) {
  const std::size_t num_names = table_.header_.cells.size();
  const std::size_t expected = num_names + row_extra_.value_or(0);
  const bool longer = line_cells_.size() > expected;
  if (longer && header_extra_ > 0) {
    if (!header_reported_) {
      errors_->Error(table_.Where(table_.header_.row, table_.header_.cells.back().data()),
                     fmt::format("column {}, behind this one, has no name; delete the column, or "
                                 "name the column",
                                 num_names + 1));
    }
    header_reported_ = true;
    return;
  }
  const char* const at = longer ? line_cells_[expected].data() : line.data() + line.size();
  const char* const whose = row_extra_.value_or(0) > 0 ? "rows above have"
                            : table_.has_header_       ? "header has"
                                                       : "first row has";
  errors_->Error(table_.Where(row_, at),
                 fmt::format("the row has {} cells, but the {} {}; {}",
                             line_cells_.size(),
                             whose,
                             expected,
                             LengthCure(longer)));
}

void TableParser::ReadRow(std::string_view line) {
  if (!Split(line)) return;
  if (!FitLength()) {
    ReportLength(line);
    return;
  }
  if (table_.rows_.empty() && table_.joined_.empty() && JoinUnits()) return;
  table_.rows_.push_back(row_);
  table_.cells_.insert(table_.cells_.end(), line_cells_.begin(), line_cells_.end());
}

bool TableParser::JoinUnits() {
  if (!says_unit_ || !table_.has_header_) return false;
  std::vector<std::string> joined;
  bool any = false;
  for (std::size_t i = 0; i < line_cells_.size(); ++i) {
    const std::string_view unit = WithoutBrackets(line_cells_[i]);
    const bool none = unit.empty() || unit == "-";
    if (!none && !says_unit_(unit)) return false;
    any = any || !none;
    joined.emplace_back(table_.header_.cells[i]);
    if (!none) joined.back() += fmt::format(" [{}]", unit);
  }
  if (!any) return false;
  // Nor do these cells say anything of the columns' numbers.
  table_.unusual_.clear();
  table_.joined_ = std::move(joined);
  AddNote(fmt::format("the units in line {}", row_.line));
  return true;
}

bool TableParser::CountsRows(int column_idx) const {
  std::optional<std::int64_t> first;
  for (int row = 0; row < table_.num_rows(); ++row) {
    const std::optional<std::int64_t> number = ParseInteger(table_.cell(row, column_idx));
    if (!number) return false;
    if (!first) first = number;
    if (*number != *first + row) return false;
  }
  // From 0 as in pandas, or from 1.
  const std::int64_t begin = first.value_or(-1);
  return begin == 0 || begin == 1;
}

void TableParser::CheckNames() {
  for (int i = 0; i < table_.num_columns(); ++i) {
    if (!table_.name(i).empty()) continue;
    if (i == 0 && table_.num_columns() > 1 && CountsRows(0)) {
      AddNote("the first column left out, for it has no name and counts the rows");
      continue;
    }
    errors_->Error(table_.NameWhere(i),
                   fmt::format("column {} of the header has no name; delete the column, or name "
                               "the column",
                               i + 1));
  }
}

void TableParser::ReadLines() {
  std::string_view rest = *table_.text_, line;
  bool have_header = false;
  while (true) {
    row_.begin = static_cast<std::size_t>(rest.data() - table_.text_->data());
    if (!TakeLine(&rest, &line)) return;
    ++row_.line;
    if (row_.line == 1 && table_.format_.stated) continue;
    if (IsNoRow(line, table_.format_)) {
      const std::string_view content = Trim(line);
      if (!have_header && !content.empty() && content[0] == '#') {
        comment_ = content;
        comment_row_ = row_;
      }
    } else if (have_header) {
      ReadRow(line);
    } else if (ReadHeader(line)) {
      have_header = true;
    } else {
      return;
    }
  }
}

void TableParser::WriteNote() {
  const std::string word = table_.format_.Word();
  if (table_.format_.separator != ',') notes_.insert(notes_.begin(), word + "s between cells");
  if (row_extra_.value_or(0) > 0) notes_.push_back(fmt::format("the {} at the end of rows", word));
  if (notes_.empty()) return;
  std::string text = "read with ";
  for (std::size_t k = 0; k < notes_.size(); ++k) {
    if (k > 0) text += k + 1 == notes_.size() ? " and " : ", ";
    text += notes_[k];
  }
  errors_->Note({table_.file_}, text);
}

std::optional<CellTable> TableParser::Parse() {
  ReadLines();
  if (table_.num_columns() == 0) {
    if (errors_->ok()) {
      errors_->Error({table_.file_}, "the recording is empty: a header and rows are expected");
    }
    return std::nullopt;
  }
  if (table_.num_rows() == 0) {
    if (errors_->ok()) {
      errors_->Error(table_.NameWhere(0), "the recording has a header, but no row below it");
    }
    return std::nullopt;
  }
  table_.unusual_.resize(table_.num_columns(), false);
  table_.doubts_.resize(table_.num_columns());
  for (std::string& note : TableNumbers(&table_).MakePlain()) AddNote(std::move(note));
  CheckNames();
  WriteNote();
  return std::move(table_);
}

}  // namespace dhcal
