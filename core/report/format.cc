#include "core/report/format.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {
namespace {

/// Exponent of ten of the first of `digits` significant digits, after rounding to them.
int ExponentOf(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::string exponent = text.substr(text.find('e') + 1);
  return static_cast<int>(*ParseInteger(exponent));
}

/// The first `count` characters of UTF-8 text, in bytes.
std::size_t BytesOf(std::string_view text, int count) {
  std::size_t bytes = 0;
  while (bytes < text.size() && CountCharacters(text.substr(0, bytes + 1)) <= count) ++bytes;
  return bytes;
}

bool IsBreak(char c) { return static_cast<unsigned char>(c) <= ' ' || c == 0x7F; }

/// Words of at most `width` characters. Control characters separate words: a report must not
/// move the cursor of the terminal that shows it.
std::vector<std::string> Words(std::string_view text, int width) {
  std::vector<std::string> words;
  std::size_t start = 0;
  while (start < text.size()) {
    if (IsBreak(text[start])) {
      ++start;
      continue;
    }
    std::size_t end = start;
    while (end < text.size() && !IsBreak(text[end])) ++end;
    std::string_view word = text.substr(start, end - start);
    while (!word.empty()) {
      const std::size_t bytes = BytesOf(word, width);
      words.emplace_back(word.substr(0, bytes));
      word.remove_prefix(bytes);
    }
    start = end;
  }
  return words;
}

}  // namespace

std::string Fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  if (!(std::abs(value) < 1e7)) return fmt::format("{:.3e}", value);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  if (zero && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string FixedWithin(double value, int decimals, int width) {
  for (int fewer = decimals; fewer >= 0; --fewer) {
    std::string text = Fixed(value, fewer);
    if (static_cast<int>(text.size()) <= width) return text;
  }
  return Scientific(value, std::max(0, width - 8));
}

std::string Scientific(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}e}", value, decimals);
}

std::string Millimetres(double metres) {
  constexpr int kDigits = 4;
  const double mm = metres / kMillimetre;
  if (mm == 0) return "0";
  if (std::abs(mm) < 1e-4) return Scientific(mm, 2);
  if (!std::isfinite(mm) || std::abs(mm) >= 1e7) return Fixed(mm, 0);
  return Fixed(mm, std::max(0, kDigits - 1 - ExponentOf(mm, kDigits)));
}

std::string WithMillimetres(double metres) {
  return std::isnan(metres) ? "not known" : Millimetres(metres) + " mm";
}

int DecimalsOf(double sigma, int otherwise) {
  if (!std::isfinite(sigma) || sigma <= 0) return otherwise;
  return std::max(0, 1 - ExponentOf(sigma, 2));
}

std::string Clip(std::string_view text, int width) {
  const int length = CountCharacters(text);
  if (length <= width) return std::string(text);
  const int head = (width - 1) / 2;
  const int tail = width - 2 - head;
  const std::size_t tail_start = BytesOf(text, length - tail);
  return fmt::format("{}..{}", text.substr(0, BytesOf(text, head)), text.substr(tail_start));
}

std::string Wrap(const std::string& first, std::string_view text) {
  const int indent = CountCharacters(first);
  std::string wrapped = first;
  int column = indent;
  bool line_is_empty = true;
  for (const std::string& word : Words(text, kReportWidth - indent)) {
    const int length = CountCharacters(word);
    if (!line_is_empty && column + 1 + length > kReportWidth) {
      wrapped += "\n" + std::string(static_cast<std::size_t>(indent), ' ');
      column = indent;
      line_is_empty = true;
    }
    if (!line_is_empty) wrapped += ' ';
    wrapped += word;
    column += length + (line_is_empty ? 0 : 1);
    line_is_empty = false;
  }
  wrapped.erase(wrapped.find_last_not_of(' ') + 1);
  return wrapped + "\n";
}

std::string Heading(const std::string& title) { return "\n" + title + "\n\n"; }

std::string AndMore(std::size_t count) {
  return fmt::format("... and {} more in result.json", count);
}

std::string Counted(int count, const std::string& singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

}  // namespace dhcal
