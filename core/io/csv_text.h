// Builds CSV text cell by cell, independent of the locale.
#ifndef DHCAL_CORE_IO_CSV_TEXT_H_
#define DHCAL_CORE_IO_CSV_TEXT_H_

#include <string>
#include <string_view>
#include <utility>

namespace dhcal {

class CsvText {
 public:
  /// The shortest digits that read back as the same double; blank for NaN and infinities.
  void Number(double value);
  void Integer(int value);
  /// Quoted where a comma, quote, line break or comment sign would be misread.
  void Label(std::string_view text);
  void Blank() { StartCell(); }
  void EndRow();

  /// The text so far; the object is empty afterwards.
  std::string Take() { return std::exchange(text_, {}); }

 private:
  void StartCell();

  std::string text_;
  bool first_cell_ = true;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_CSV_TEXT_H_
