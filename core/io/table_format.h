// How the cells of a text table are separated, found from its first lines.
#ifndef DHCAL_CORE_IO_TABLE_FORMAT_H_
#define DHCAL_CORE_IO_TABLE_FORMAT_H_

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dhcal {

struct TableFormat {
  char separator = ',';  // ' ' = runs of blanks
  bool stated = false;   // the first line says so: "sep=;"

  bool blanks() const { return separator == ' '; }
  /// "comma", "semicolon", "tab", "blank".
  std::string Word() const;
};

/// Takes the next line without its end, "\n", "\r\n" or "\r", off `*rest`; false at the end.
bool TakeLine(std::string_view* rest, std::string_view* line);

/// A line that holds no row: nothing but blanks and separators, or a comment. Lines that start with
/// a spreadsheet's error value (#N/A) are rows.
bool IsNoRow(std::string_view line, const TableFormat& format);

/// The cells of a line without blanks and quotes around them; what is wrong with it stays unsaid.
std::vector<std::string_view> CellsOf(std::string_view line, const TableFormat& format);

/// The separator under which the first rows hold most numbers.
TableFormat GuessFormat(std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_TABLE_FORMAT_H_
