#include "problems/formats/recording/column_spelling.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>
#include <vector>

#include "core/base/text.h"

namespace dhcal {

namespace {

/// Units as people write them, in lower case, and as our names end.
const std::map<std::string, std::string>& UnitWords() {
  static const std::map<std::string, std::string> units = {{"deg", "deg"},
                                                           {"degree", "deg"},
                                                           {"degrees", "deg"},
                                                           {"\xC2\xB0", "deg"},
                                                           {"rad", "rad"},
                                                           {"radian", "rad"},
                                                           {"radians", "rad"},
                                                           {"mrad", "mrad"},
                                                           {"mm", "mm"},
                                                           {"millimeter", "mm"},
                                                           {"millimeters", "mm"},
                                                           {"millimetre", "mm"},
                                                           {"millimetres", "mm"},
                                                           {"m", "m"},
                                                           {"meter", "m"},
                                                           {"meters", "m"},
                                                           {"metre", "m"},
                                                           {"metres", "m"},
                                                           {"cm", "cm"},
                                                           {"um", "um"},
                                                           {"\xC2\xB5m", "um"},
                                                           {"\xCE\xBCm", "um"},
                                                           {"in", "in"},
                                                           {"inch", "in"},
                                                           {"inches", "in"},
                                                           {"s", "s"},
                                                           {"sec", "s"},
                                                           {"second", "s"},
                                                           {"seconds", "s"},
                                                           {"ms", "ms"},
                                                           {"kg", "kg"},
                                                           {"c", "C"},
                                                           {"degc", "C"},
                                                           {"\xC2\xB0"
                                                            "c",
                                                            "C"},
                                                           {"celsius", "C"},
                                                           {"k", "K"},
                                                           {"n", "N"},
                                                           {"nm", "Nm"},
                                                           {"n*m", "Nm"},
                                                           {"n.m", "Nm"},
                                                           {"n\xC2\xB7m", "Nm"},
                                                           {"deg_s", "deg_s"},
                                                           {"deg/s", "deg_s"},
                                                           {"\xC2\xB0/s", "deg_s"},
                                                           {"rad_s", "rad_s"},
                                                           {"rad/s", "rad_s"},
                                                           {"mm_s", "mm_s"},
                                                           {"mm/s", "mm_s"},
                                                           {"m_s", "m_s"},
                                                           {"m/s", "m_s"}};
  return units;
}

std::string UnitOf(std::string_view text) {
  const auto found = UnitWords().find(std::string(Trim(text)));
  return found == UnitWords().end() ? "" : found->second;
}

/// Letters of other alphabets, and the degree sign, are parts of words.
bool IsWordByte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0;
}

std::vector<std::string> WordsOf(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text) {
    if (IsWordByte(c)) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "_") + word;
  return text;
}

/// Takes a unit in brackets off the end of `name`: "x [mm]", "x(mm)".
std::string TakeUnitInBrackets(std::string_view* name) {
  if (name->empty() || (name->back() != ']' && name->back() != ')')) return "";
  const std::size_t open = name->find_last_of("[(");
  if (open == std::string_view::npos) return "";
  std::string unit = UnitOf(name->substr(open + 1, name->size() - open - 2));
  if (!unit.empty()) *name = Trim(name->substr(0, open));
  return unit;
}

/// Takes a unit off the end: "x_mm", "qd1_deg_s". A name is more than its unit.
std::string TakeUnitWord(std::vector<std::string>* words) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{1}}) {
    if (words->size() <= count) continue;
    const auto begin = words->end() - static_cast<std::ptrdiff_t>(count);
    std::string unit = UnitOf(Joined({begin, words->end()}));
    if (unit.empty()) continue;
    words->erase(begin, words->end());
    return unit;
  }
  return "";
}

std::optional<int> TakeNumber(std::vector<std::string>* words) {
  constexpr std::size_t kMostDigits = 4;
  if (words->empty()) return std::nullopt;
  std::string& last = words->back();
  std::size_t begin = last.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(last[begin - 1])) != 0) --begin;
  if (begin == last.size() || last.size() - begin > kMostDigits) return std::nullopt;
  // A number alone is no name.
  if (begin == 0 && words->size() == 1) return std::nullopt;
  const std::optional<std::int64_t> number = ParseInteger(last.substr(begin));
  last.resize(begin);
  if (last.empty()) words->pop_back();
  return static_cast<int>(*number);
}

}  // namespace

std::string ColumnSpelling::all_words() const {
  if (!number) return words;
  // "wrist1" and "wrist_1" are the same.
  return words + "_" + std::to_string(*number);
}

ColumnSpelling Spell(std::string_view name) {
  ColumnSpelling spelling;
  const std::string lower = InLowerCase(Trim(name));
  std::string_view rest = lower;
  spelling.unit = TakeUnitInBrackets(&rest);
  std::vector<std::string> words = WordsOf(rest);
  // "x_mm [mm]" says it twice.
  std::vector<std::string> without = words;
  const std::string unit = TakeUnitWord(&without);
  if (spelling.unit.empty()) spelling.unit = unit;
  if (spelling.unit == unit) words = without;
  spelling.number = TakeNumber(&words);
  if (spelling.number && spelling.unit.empty()) spelling.unit = TakeUnitWord(&words);  // q_deg(1)
  spelling.words = Joined(words);
  return spelling;
}

bool IsUnitWord(std::string_view text) { return !UnitOf(InLowerCase(text)).empty(); }

std::string YamlWord(std::string_view text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '.';
  });
  if (plain) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "\"";
}

}  // namespace dhcal
