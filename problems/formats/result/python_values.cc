#include "problems/formats/result/python_values.h"

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"

namespace dhcal {

std::string PythonText(std::string_view text) {
  constexpr unsigned char kFirstPrintable = 0x20, kFirstNotAscii = 0x7f;
  const bool is_utf8 = !FindInvalidUtf8(text).has_value();
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= kFirstPrintable && (byte < kFirstNotAscii || is_utf8);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (plain && byte != kFirstNotAscii) {
      quoted += c;
    } else {
      quoted += fmt::format("\\x{:02x}", byte);
    }
  }
  return quoted + "\"";
}

std::string PythonNumber(double value) { return fmt::format("{}", value); }

std::string PythonValue(const Eigen::Vector3d& vector) {
  return fmt::format("[{}, {}, {}]", vector.x(), vector.y(), vector.z());
}

std::string PythonValue(const Eigen::Isometry3d& X) {
  std::vector<std::string> rows;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector4d row = X.matrix().row(i);
    rows.push_back(fmt::format("[{}, {}, {}, {}]", row[0], row[1], row[2], row[3]));
  }
  return fmt::format("[{}, [0.0, 0.0, 0.0, 1.0]]", fmt::join(rows, ", "));
}

std::string PythonValue(const std::map<std::string, double>& numbers) {
  std::vector<std::string> entries;
  for (const auto& [name, value] : numbers) {
    entries.push_back(fmt::format("{}: {}", PythonText(name), value));
  }
  return fmt::format("{{{}}}", fmt::join(entries, ", "));
}

std::string PythonList(const std::vector<std::string>& values) {
  return values.empty() ? "[]" : fmt::format("[\n    {},\n]", fmt::join(values, ",\n    "));
}

}  // namespace dhcal
