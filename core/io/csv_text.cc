#include "core/io/csv_text.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/text.h"

namespace dhcal {

void CsvText::StartCell() {
  if (!first_cell_) text_ += ',';
  first_cell_ = false;
}

void CsvText::Number(double value) {
  StartCell();
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(text_), "{}", value);
}

void CsvText::Integer(int value) {
  StartCell();
  fmt::format_to(std::back_inserter(text_), "{}", value);
}

void CsvText::Label(std::string_view text) {
  StartCell();
  const bool padded = Trim(text).size() < text.size();
  if (!padded && text.find_first_of(",\"\r\n#") == std::string_view::npos) {
    text_ += text;
    return;
  }
  text_ += '"';
  for (const char c : text) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
}

void CsvText::EndRow() {
  text_ += '\n';
  first_cell_ = true;
}

}  // namespace dhcal
