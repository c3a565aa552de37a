// Small work on text that input readers share. Nothing here depends on the locale.
#ifndef DHCAL_CORE_BASE_TEXT_H_
#define DHCAL_CORE_BASE_TEXT_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dhcal {

/// The finite number that `text` is as a whole ("1", "+.5", "-2e-3"), or nothing: no blanks
/// around it, no hexadecimal, no nan or inf, nothing that a double cannot hold.
std::optional<double> ParseDouble(std::string_view text);

/// The same for whole numbers.
std::optional<std::int64_t> ParseInteger(std::string_view text);
std::optional<std::uint64_t> ParseUnsigned(std::string_view text);

/// Without blanks and tabs at both ends.
std::string_view Trim(std::string_view text);

bool StartsWith(std::string_view text, std::string_view prefix);
bool EndsWith(std::string_view text, std::string_view suffix);

/// ASCII letters only, whatever the locale: the rest stays.
std::string InLowerCase(std::string_view text);
/// The first letter of a sentence: "joint 2 is ..." -> "Joint 2 is ...".
std::string Capitalised(std::string text);

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`; upper and
/// lower case count as equal.
int EditDistance(std::string_view a, std::string_view b);

/// The candidate that `name` was probably meant to be, or "" when none is near. A candidate that
/// only adds an ending ("a" -> "a_mm") is near.
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);

/// "'a'", "'a' or 'b'", "'a', 'b' or 'c'"; `last` stands in place of "or".
std::string QuotedList(const std::vector<std::string>& names, std::string_view last = "or");

/// Characters (code points) in UTF-8 text.
int CountCharacters(std::string_view utf8);

/// Offset of the first byte that is not UTF-8, or nothing when all is.
std::optional<std::size_t> FindInvalidUtf8(std::string_view text);

/// A text from a file made fit for a message: cut when long, control characters replaced.
std::string Printable(std::string_view text);

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_TEXT_H_
