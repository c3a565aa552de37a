#include "core/io/text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/base/text.h"

namespace dhcal {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

SourceLocation PlaceOf(const std::string& file, std::string_view content, std::size_t offset) {
  const std::string_view before = content.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  return {file, static_cast<int>(line), 1 + CountCharacters(before.substr(start))};
}

/// Reads to the end of the file or to the first chunk with a NUL byte: a device that never ends
/// must not fill the memory.
bool ReadUntilNul(std::ifstream* stream, std::string* content) {
  std::array<char, 1 << 16> chunk;
  while (true) {
    stream->read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const std::string_view part(chunk.data(), static_cast<std::size_t>(stream->gcount()));
    content->append(part);
    if (part.find('\0') != std::string_view::npos) return true;
    if (!*stream) return !stream->bad();
  }
}

bool LooksLikeUtf16(std::string_view content) {
  return StartsWith(content, "\xFF\xFE") || StartsWith(content, "\xFE\xFF");
}

/// Adds an error when `content` is not plain UTF-8 text.
bool IsText(const std::string& file, std::string_view content, Diagnostics* diagnostics) {
  if (LooksLikeUtf16(content)) {
    diagnostics->Error({file, 1, 1}, "the file is UTF-16 text; save it as UTF-8");
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

std::optional<std::string> ReadTextFile(const std::string& file, Diagnostics* diagnostics) {
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
  if (StartsWith(content, kByteOrderMark)) content.erase(0, kByteOrderMark.size());
  if (content.empty()) return fail("the file is empty");
  if (!IsText(file, content, diagnostics)) return std::nullopt;
  return content;
}

}  // namespace dhcal
