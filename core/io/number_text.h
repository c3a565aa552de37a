// Numbers as spreadsheets and people write them: decimal commas, thousands separators, typographic
// minus signs, and the words for "no value". Independent of the locale.
#ifndef DHCAL_CORE_IO_NUMBER_TEXT_H_
#define DHCAL_CORE_IO_NUMBER_TEXT_H_

#include <optional>
#include <string>
#include <string_view>

namespace dhcal {

/// How a number is written, under one reading of its decimal mark.
struct NumberForm {
  char group = 0;          // between thousands: '.', ',', ' ' or '\''; 0 = nothing
  bool has_mark = false;   // a decimal mark is there
  bool odd_minus = false;  // a minus sign other than '-'
};

/// The form of `text` if `mark` ('.' or ',') is the decimal mark; nothing when it is no number
/// then. Thousands are groups of three digits behind one to three that do not start with 0.
std::optional<NumberForm> FormOf(std::string_view text, char mark);

/// Whether it is a number under at least one decimal mark.
bool IsNumberText(std::string_view text);

/// Whether the decimal mark decides what the number is worth: "1,234", "1.234".
bool IsOpen(const std::optional<NumberForm>& with_point,
            const std::optional<NumberForm>& with_comma);

/// A number that has a form under `mark`, as ParseDouble reads it: "-2392.6452".
std::string PlainNumber(std::string_view text, char mark);

/// Words that programs write where nothing was measured: "NaN", "N/A", "#WERT!", "-", "null" ...
bool IsBlankWord(std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_NUMBER_TEXT_H_
