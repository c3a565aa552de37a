#include "core/io/number_text.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/text.h"

namespace dhcal {

namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// What stands at the start of a text, and its bytes; length 0 = nothing of the kind.
struct Sign {
  std::size_t length = 0;
  bool minus = false;
  bool odd = false;
};

Sign SignAt(std::string_view text) {
  if (text.empty()) return {};
  if (text[0] == '-') return {1, true, false};
  if (text[0] == '+') return {1, false, false};
  // U+2212 minus; the en dash U+2013, which word processors make of a hyphen.
  for (const std::string_view dash : {"\xE2\x88\x92", "\xE2\x80\x93"}) {
    if (StartsWith(text, dash)) return {dash.size(), true, true};
  }
  return {};
}

struct Group {
  std::size_t length = 0;
  char kind = 0;
};

Group GroupAt(std::string_view text) {
  if (text.empty()) return {};
  if (text[0] == '.' || text[0] == ',' || text[0] == ' ' || text[0] == '\'') return {1, text[0]};
  // No-break, thin and narrow no-break space; the typographic apostrophe.
  for (const std::string_view blank : {"\xC2\xA0", "\xE2\x80\x89", "\xE2\x80\xAF"}) {
    if (StartsWith(text, blank)) return {blank.size(), ' '};
  }
  if (StartsWith(text, "\xE2\x80\x99")) return {3, '\''};
  return {};
}

std::size_t CountDigits(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && IsDigit(text[count])) ++count;
  return count;
}

/// Walks over a number's parts and hands each digit and mark, made plain, to `write`.
class NumberScanner {
 public:
  NumberScanner(std::string_view text, char mark, std::string* plain)
      : rest_(text), mark_(mark), plain_(plain) {}

  std::optional<NumberForm> Scan() {
    TakeSign();
    const std::size_t before = TakeInteger();
    std::size_t after = 0;
    if (!rest_.empty() && rest_[0] == mark_) {
      form_.has_mark = true;
      rest_.remove_prefix(1);
      Write(".");
      after = TakeDigits();
    }
    if (before + after == 0 || !TakeExponent() || !rest_.empty()) return std::nullopt;
    return form_;
  }

 private:
  void Write(std::string_view text) {
    if (plain_ != nullptr) *plain_ += text;
  }

  void TakeSign() {
    const Sign sign = SignAt(rest_);
    rest_.remove_prefix(sign.length);
    form_.odd_minus = form_.odd_minus || sign.odd;
    if (sign.minus) Write("-");
  }

  std::size_t TakeDigits() {
    const std::size_t count = CountDigits(rest_);
    Write(rest_.substr(0, count));
    rest_.remove_prefix(count);
    return count;
  }

  /// Digits, or groups of three behind the first; returns how many.
  std::size_t TakeInteger() {
    const bool leading_zero = !rest_.empty() && rest_[0] == '0';
    std::size_t count = TakeDigits();
    if (count == 0 || count > 3 || leading_zero) return count;
    while (true) {
      const Group group = GroupAt(rest_);
      const bool fits = group.length > 0 && group.kind != mark_ &&
                        (form_.group == 0 || form_.group == group.kind) &&
                        CountDigits(rest_.substr(group.length)) == 3;
      if (!fits) return count;
      form_.group = group.kind;
      rest_.remove_prefix(group.length);
      count += TakeDigits();
    }
  }

  bool TakeExponent() {
    if (rest_.empty() || (rest_[0] != 'e' && rest_[0] != 'E')) return true;
    rest_.remove_prefix(1);
    Write("e");
    TakeSign();
    return TakeDigits() > 0;
  }

  std::string_view rest_;
  char mark_;
  std::string* plain_;
  NumberForm form_;
};

}  // namespace

std::optional<NumberForm> FormOf(std::string_view text, char mark) {
  return NumberScanner(text, mark, nullptr).Scan();
}

bool IsNumberText(std::string_view text) {
  return FormOf(text, '.').has_value() || FormOf(text, ',').has_value();
}

bool IsOpen(const std::optional<NumberForm>& with_point,
            const std::optional<NumberForm>& with_comma) {
  return with_point && with_comma && (with_point->has_mark || with_comma->has_mark);
}

std::string PlainNumber(std::string_view text, char mark) {
  std::string plain;
  NumberScanner(text, mark, &plain).Scan();
  return plain;
}

bool IsBlankWord(std::string_view text) {
  constexpr std::size_t kLongest = 8;
  static constexpr std::array<std::string_view, 22> kWords = {
      "nan",    "na",           "n/a",          "n.a.",        "#n/a",    "#nv",
      "#wert!", "#value!",      "-nan",         "#div/0!",     "#bezug!", "#ref!",
      "#zahl!", "#num!",        "#name?",       "null",        "none",    "-",
      "--",     "\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x88\x92"};
  if (text.empty() || text.size() > kLongest) return false;
  return std::find(kWords.begin(), kWords.end(), InLowerCase(text)) != kWords.end();
}

}  // namespace dhcal
