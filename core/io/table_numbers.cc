#include "core/io/table_numbers.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {

namespace {

/// A byte that CountCharacters passes over: places further on in the line stay right.
constexpr char kNoCharacter = '\x80';

/// Puts `plain`, which has no more characters, in the place of `cell`, which starts at `begin`.
std::string_view Replace(std::string_view cell, const std::string& plain, char* begin) {
  const int characters = CountCharacters(cell);
  char* rest = std::copy(plain.begin(), plain.end(), begin);
  for (int k = static_cast<int>(plain.size()); k < characters; ++k) *rest++ = ' ';
  std::fill(rest, begin + cell.size(), kNoCharacter);
  return {begin, plain.size()};
}

std::string GroupWord(char group) {
  switch (group) {
    case '.':
      return "points";
    case ',':
      return "commas";
    case ' ':
      return "blanks";
    default:
      return "apostrophes";
  }
}

}  // namespace

TableNumbers::Evidence TableNumbers::LookAt(int column_idx) {
  Evidence evidence;
  for (int row = 0; row < table_.num_rows(); ++row) {
    std::string_view& cell = table_.cells_[table_.CellIndex(row, column_idx)];
    if (cell.empty()) continue;
    if (IsBlankWord(cell)) {
      const std::string word(cell);
      if (std::find(blank_words_.begin(), blank_words_.end(), word) == blank_words_.end()) {
        blank_words_.push_back(word);
      }
      cell.remove_suffix(cell.size());
      continue;
    }
    const std::optional<NumberForm> point = FormOf(cell, '.'), comma = FormOf(cell, ',');
    evidence.point = evidence.point || (point && !comma);
    evidence.comma = evidence.comma || (comma && !point);
    if (!IsOpen(point, comma)) continue;
    if (evidence.open_row < 0) evidence.open_row = row;
    (comma->has_mark ? evidence.open_comma : evidence.open_point) = true;
  }
  return evidence;
}

std::string TableNumbers::Doubt(int row_idx, int column_idx) const {
  const std::string_view cell = table_.cell(row_idx, column_idx);
  return fmt::format(
      "'{}' may be {} or {}, and nothing in the file tells which; write numbers without separators "
      "between thousands",
      Printable(cell),
      PlainNumber(cell, '.'),
      PlainNumber(cell, ','));
}

void TableNumbers::RewriteCell(std::string_view* cell, char mark, const NumberForm& form) {
  const bool comma = form.has_mark && mark == ',';
  if (form.group != 0 && groups_.find(form.group) == std::string::npos) groups_ += form.group;
  decimal_commas_ = decimal_commas_ || comma;
  odd_minus_ = odd_minus_ || form.odd_minus;
  char* const begin = table_.text_->data() + (cell->data() - table_.text_->data());
  if (form.group != 0 || form.odd_minus) {
    *cell = Replace(*cell, PlainNumber(*cell, mark), begin);
  } else if (comma) {
    begin[cell->find(',')] = '.';  // by far the most frequent
  }
}

void TableNumbers::Rewrite(int column_idx, char mark) {
  for (int row = 0; row < table_.num_rows(); ++row) {
    std::string_view& cell = table_.cells_[table_.CellIndex(row, column_idx)];
    if (const std::optional<NumberForm> form = FormOf(cell, mark)) RewriteCell(&cell, mark, *form);
  }
}

void TableNumbers::Decide(int column_idx,
                          const Evidence& evidence,
                          bool file_point,
                          bool file_comma) {
  const bool own = evidence.point || evidence.comma;
  if (own || evidence.open_row < 0) {
    // With cells of both kinds, those with commas are left for the reader to refuse.
    Rewrite(column_idx, evidence.comma && !evidence.point ? ',' : '.');
    return;
  }
  const bool agreed = file_point != file_comma && evidence.open_comma == file_comma &&
                      evidence.open_point == file_point;
  if (agreed) {
    Rewrite(column_idx, file_comma ? ',' : '.');
  } else {
    table_.doubts_[column_idx] = {evidence.open_row, Doubt(evidence.open_row, column_idx)};
  }
}

std::vector<std::string> TableNumbers::MakePlain() {
  const int num_columns = table_.num_columns();
  std::vector<Evidence> evidence(num_columns);
  bool any_comma = false;
  for (int i = 0; i < num_columns; ++i) {
    if (table_.unusual_[i]) evidence[i] = LookAt(i);
    any_comma = any_comma || evidence[i].comma || evidence[i].open_comma;
  }
  bool file_point = false, file_comma = false;
  for (int i = 0; i < num_columns; ++i) {
    // Columns of plain numbers matter only where others have commas.
    const bool plain = !table_.unusual_[i];
    if (plain && any_comma) evidence[i] = LookAt(i);
    file_point = file_point || evidence[i].point;
    file_comma = file_comma || evidence[i].comma;
  }
  for (int i = 0; i < num_columns; ++i) {
    const bool plain = !table_.unusual_[i];
    if (!plain || any_comma) Decide(i, evidence[i], file_point, file_comma);
  }
  std::vector<std::string> done;
  if (decimal_commas_) done.emplace_back("decimal commas");
  for (const char group : groups_) done.push_back(GroupWord(group) + " between thousands");
  if (odd_minus_) done.emplace_back("typographic minus signs");
  if (!blank_words_.empty()) done.push_back(QuotedList(blank_words_, "and") + " as blank cells");
  return done;
}

}  // namespace dhcal
