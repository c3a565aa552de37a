#include "core/io/text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <boost/locale/encoding_utf.hpp>

#include "core/base/text.h"

namespace dhcal {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kLittleEndianMark = "\xFF\xFE";
constexpr std::string_view kBigEndianMark = "\xFE\xFF";

SourceLocation PlaceOf(const std::string& file, std::string_view content, std::size_t offset) {
  const std::string_view before = content.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  return {file, static_cast<int>(line), 1 + CountCharacters(before.substr(start))};
}

bool IsUtf16(std::string_view content) {
  return StartsWith(content, kLittleEndianMark) || StartsWith(content, kBigEndianMark);
}

/// Reads to the end of the file or to the first chunk with a NUL byte, which only UTF-16 text has:
/// a device that never ends must not fill the memory.
bool ReadUntilNul(std::ifstream* stream, std::string* content) {
  std::array<char, 1 << 16> chunk;
  while (true) {
    stream->read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const std::string_view part(chunk.data(), static_cast<std::size_t>(stream->gcount()));
    content->append(part);
    if (part.find('\0') != std::string_view::npos && !IsUtf16(*content)) return true;
    if (!*stream) return !stream->bad();
  }
}

/// UTF-8 of UTF-16 with its byte order mark, or nothing when a character is broken.
std::optional<std::string> FromUtf16(std::string_view content) {
  const bool little = StartsWith(content, kLittleEndianMark);
  if (content.size() % 2 != 0) return std::nullopt;
  std::u16string units;
  units.reserve(content.size() / 2);
  for (std::size_t i = 2; i < content.size(); i += 2) {
    const unsigned first = static_cast<unsigned char>(content[i]);
    const unsigned second = static_cast<unsigned char>(content[i + 1]);
    units.push_back(static_cast<char16_t>(little ? second << 8u | first : first << 8u | second));
  }
  try {
    return boost::locale::conv::utf_to_utf<char>(units, boost::locale::conv::stop);
  } catch (const boost::locale::conv::conversion_error&) {
    return std::nullopt;
  }
}

/// What a file that is no text is, by its first bytes, and what to do; "" when they say nothing.
std::string KnownBinary(std::string_view content) {
  if (StartsWith(content, "PK\x03\x04")) {
    return "this is an Excel workbook (.xlsx) or another zipped file; save it as 'CSV UTF-8'";
  }
  if (StartsWith(content, "\xD0\xCF\x11\xE0")) {
    return "this is an Excel workbook (.xls); save it as 'CSV UTF-8'";
  }
  if (StartsWith(content, "\x1F\x8B")) return "the file is compressed (gzip); unpack it";
  return "";
}

/// Adds an error when `content` is no UTF-8 text.
bool IsText(const std::string& file, std::string_view content, Diagnostics* diagnostics) {
  if (const std::string known = KnownBinary(content); !known.empty()) {
    diagnostics->Error({file}, known);
    return false;
  }
  const std::size_t nul = content.find('\0');
  if (nul != std::string_view::npos) {
    diagnostics->Error(PlaceOf(file, content, nul),
                       "the file holds a NUL byte, so it is binary; a text file is expected");
    return false;
  }
  if (const std::optional<std::size_t> invalid = FindInvalidUtf8(content)) {
    diagnostics->Error(PlaceOf(file, content, *invalid),
                       "the text is not valid UTF-8 here; save the file as UTF-8");
    return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> ReadTextFile(const std::string& file,
                                        Diagnostics* diagnostics,
                                        bool* utf16) {
  const auto fail = [&](const std::string& message) -> std::optional<std::string> {
    diagnostics->Error({file}, message);
    return std::nullopt;
  };
  std::error_code status;
  if (!std::filesystem::exists(file, status)) {
    return fail("there is no such file; check the path");
  }
  if (std::filesystem::is_directory(file, status)) {
    return fail("this is a folder; the path of a file is expected");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail("the file cannot be opened; check its permissions");
  std::string content;
  if (!ReadUntilNul(&stream, &content)) return fail("the file cannot be read to its end");
  if (IsUtf16(content)) {
    std::optional<std::string> converted = FromUtf16(content);
    if (!converted) return fail("the file is UTF-16 text with broken characters; save it as UTF-8");
    content = std::move(*converted);
    if (utf16 != nullptr) *utf16 = true;
  }
  if (StartsWith(content, kByteOrderMark)) content.erase(0, kByteOrderMark.size());
  if (content.empty()) return fail("the file is empty");
  if (!IsText(file, content, diagnostics)) return std::nullopt;
  return content;
}

}  // namespace dhcal
