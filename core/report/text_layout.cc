#include "core/report/text_layout.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {
namespace {

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

/// A number and its uncertainty stay together: "0.31 +- 0.02".
std::vector<std::string> WithUncertaintiesWhole(std::vector<std::string> words, int width) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (words[i] != "+-") continue;
    const std::string whole = fmt::format("{} +- {}", words[i - 1], words[i + 1]);
    if (CountCharacters(whole) > width) continue;
    words[i - 1] = whole;
    words.erase(words.begin() + static_cast<long>(i), words.begin() + static_cast<long>(i) + 2);
  }
  return words;
}

}  // namespace

std::string Spaces(int count) {
  return std::string(static_cast<std::size_t>(std::max(0, count)), ' ');
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
  const int width = kReportWidth - indent;
  for (const std::string& word : WithUncertaintiesWhole(Words(text, width), width)) {
    const int length = CountCharacters(word);
    if (!line_is_empty && column + 1 + length > kReportWidth) {
      wrapped += "\n" + Spaces(indent);
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

}  // namespace dhcal
