#include "core/report/html/html_text.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/text.h"

namespace dhcal {
namespace {

constexpr char kReplacement[] = "\xEF\xBF\xBD";  // U+FFFD

std::string AsUtf8(std::string_view text) {
  std::string valid;
  for (;;) {
    const std::optional<std::size_t> bad = FindInvalidUtf8(text);
    valid += text.substr(0, bad.value_or(text.size()));
    if (!bad) return valid;
    valid += kReplacement;
    text.remove_prefix(*bad + 1);
  }
}

}  // namespace

std::string Escaped(std::string_view text) {
  constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7f;
  std::string escaped;
  for (const char c : AsUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\'') {
      escaped += "&#39;";
    } else {
      escaped += byte < kFirstPrintable || byte == kDelete ? ' ' : c;
    }
  }
  return escaped;
}

std::string Base64(std::string_view bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t kGroup = 3;  // bytes that make four digits
  std::string text;
  text.reserve((bytes.size() + kGroup - 1) / kGroup * 4);
  for (std::size_t i = 0; i < bytes.size(); i += kGroup) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kGroup; ++k) {
      const bool there = i + k < bytes.size();
      bits = bits << 8U | (there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    const std::size_t left = bytes.size() - i;
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const bool filled = digit <= left;
      text += filled ? kDigits[bits >> (18U - 6U * digit) & 63U] : '=';
    }
  }
  return text;
}

std::string InSentenceCase(std::string_view title) { return Capitalised(InLowerCase(title)); }

}  // namespace dhcal
