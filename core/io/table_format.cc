#include "core/io/table_format.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/io/number_text.h"

namespace dhcal {

namespace {

/// The separator that a spreadsheet's own first line names: "sep=;", quoted or not.
std::optional<char> StatedSeparator(std::string_view line) {
  line = Trim(line);
  if (line.size() >= 2 && line.front() == '"' && line.back() == '"') {
    line = line.substr(1, line.size() - 2);
  }
  if (!StartsWith(line, "sep=") && !StartsWith(line, "SEP=")) return std::nullopt;
  if (line.size() > 5) return std::nullopt;
  const char separator = line.size() == 5 ? line[4] : '\t';  // a tab at the end was trimmed off
  const bool known = separator == ',' || separator == ';' || separator == '\t';
  return known ? std::optional(separator) : std::nullopt;
}

/// How well the first lines read under a separator.
struct Score {
  double numbers = 0;     // share of the rows' cells that are numbers or blank
  std::size_t cells = 0;  // of the first line
};

Score ScoreOf(const std::vector<std::string_view>& lines, const TableFormat& format) {
  Score score;
  score.cells = CellsOf(lines[0], format).size();
  std::size_t total = 0, numbers = 0;
  // Of a single line nothing but its own cells can be looked at.
  for (std::size_t k = lines.size() > 1 ? 1 : 0; k < lines.size(); ++k) {
    const std::vector<std::string_view> cells = CellsOf(lines[k], format);
    // Blanks stand inside names and texts, too: they separate only where all rows agree.
    if (format.blanks() && cells.size() != score.cells) return {};
    for (const std::string_view cell : cells) {
      ++total;
      if (cell.empty() || IsNumberText(cell) || IsBlankWord(cell)) ++numbers;
    }
  }
  score.numbers = total == 0 ? 0 : static_cast<double>(numbers) / static_cast<double>(total);
  return score;
}

bool Better(const Score& score, const Score& best) {
  constexpr double kSame = 1e-9;
  if (score.numbers > best.numbers + kSame) return true;
  return score.numbers > best.numbers - kSame && score.cells > best.cells;
}

/// A row that starts with a spreadsheet's error value, not a comment.
bool StartsWithErrorValue(std::string_view line) {
  return IsBlankWord(Trim(line.substr(0, line.find_first_of(",;\t "))));
}

/// "[mm]", "(mm)": part of the name before it.
bool IsUnit(std::string_view cell) {
  return cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') ||
                             (cell.front() == '(' && cell.back() == ')'));
}

/// Takes a cell's end and the separator behind it off `rest`.
std::string_view TakeCell(std::string_view* rest, char separator) {
  std::size_t end = 0;
  if (!rest->empty() && rest->front() == '"') {
    end = std::min(rest->find('"', 1), rest->size() - 1) + 1;
    // Doubled quotes inside.
    while (end < rest->size() && (*rest)[end] == '"') {
      end = std::min(rest->find('"', end + 1), rest->size() - 1) + 1;
    }
  }
  end = std::min(rest->find(separator, end), rest->size());
  std::string_view cell = Trim(rest->substr(0, end));
  rest->remove_prefix(end);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = cell.substr(1, cell.size() - 2);
  }
  return cell;
}

}  // namespace

std::string TableFormat::Word() const {
  switch (separator) {
    case ';':
      return "semicolon";
    case '\t':
      return "tab";
    case ' ':
      return "blank";
    default:
      return "comma";
  }
}

bool TakeLine(std::string_view* rest, std::string_view* line) {
  if (rest->empty()) return false;
  // Several times quicker than find_first_of, which searches the set for each character.
  std::size_t end = 0;
  while (end < rest->size() && (*rest)[end] != '\n' && (*rest)[end] != '\r') ++end;
  *line = rest->substr(0, end);
  const bool two = rest->substr(end, 2) == "\r\n";
  rest->remove_prefix(std::min(end + (two ? 2 : 1), rest->size()));
  return true;
}

bool IsNoRow(std::string_view line, const TableFormat& format) {
  std::size_t first = 0;
  while (first < line.size() &&
         (line[first] == ' ' || line[first] == '\t' || line[first] == format.separator)) {
    ++first;
  }
  if (first == line.size()) return true;
  const std::string_view content = Trim(line);
  return content[0] == '#' && !StartsWithErrorValue(content);
}

std::vector<std::string_view> CellsOf(std::string_view line, const TableFormat& format) {
  std::vector<std::string_view> cells;
  std::string_view rest = Trim(line);
  if (!format.blanks()) rest = line;
  while (true) {
    while (!rest.empty() && rest.front() != format.separator &&
           (rest.front() == ' ' || rest.front() == '\t')) {
      rest.remove_prefix(1);
    }
    const std::string_view cell = TakeCell(&rest, format.separator);
    if (format.blanks() && IsUnit(cell) && !cells.empty()) {
      const char* const begin = cells.back().data();
      cells.back() = {begin, static_cast<std::size_t>(cell.data() + cell.size() - begin)};
    } else {
      cells.push_back(cell);
    }
    if (rest.empty()) return cells;
    rest.remove_prefix(1);
    if (format.blanks()) rest = Trim(rest);
  }
}

TableFormat GuessFormat(std::string_view text) {
  constexpr std::size_t kLines = 20;
  std::string_view rest = text, line;
  std::vector<std::string_view> lines;
  while (lines.size() < kLines && TakeLine(&rest, &line)) {
    const std::optional<char> stated =
        line.data() == text.data() ? StatedSeparator(line) : std::nullopt;
    if (stated) return {*stated, true};
    if (!IsNoRow(line, {','}) && !IsNoRow(line, {';'})) lines.push_back(line);
  }
  TableFormat best;
  if (lines.empty()) return best;
  Score best_score = ScoreOf(lines, best);
  for (const char separator : {';', '\t', ' '}) {
    const TableFormat format{separator};
    const Score score = ScoreOf(lines, format);
    // Names and texts hold blanks: these separate only where nothing else does, or rows prove it.
    const bool possible = !format.blanks() || best_score.cells == 1 || score.numbers == 1;
    if (score.cells < 2 || !possible || !Better(score, best_score)) continue;
    best = format;
    best_score = score;
  }
  return best;
}

}  // namespace dhcal
