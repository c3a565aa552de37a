#include "problems/formats/exchange/ur_calibration.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/text_file.h"

namespace dhcal {
namespace {

/// "key = value # comment" of a line of the section `mounting`.
struct Entry {
  std::string_view value;
  SourceLocation where;  // of the value
};

using Entries = std::map<std::string, Entry, std::less<>>;

Entries MountingOf(const std::string& file, std::string_view text) {
  Entries entries;
  std::string section;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string_view content = Trim(line.substr(0, line.find_first_of("#;")));
    if (EndsWith(content, "\r")) content = Trim(content.substr(0, content.size() - 1));
    if (StartsWith(content, "[") && EndsWith(content, "]")) {
      section = Trim(content.substr(1, content.size() - 2));
      continue;
    }
    const std::size_t equals = content.find('=');
    if (section != "mounting" || equals == std::string_view::npos) continue;
    const std::string_view value = Trim(content.substr(equals + 1));
    const auto column = static_cast<int>(value.data() - line.data()) + 1;
    entries[std::string(Trim(content.substr(0, equals)))] = {value, {file, number, column}};
  }
  return entries;
}

std::vector<double> ListOf(const std::string& key, const Entry& entry, Diagnostics* diagnostics) {
  std::string_view rest = entry.value;
  if (!StartsWith(rest, "[") || !EndsWith(rest, "]")) {
    diagnostics->Error(entry.where, fmt::format("'{}' is no list of numbers, [x, y, ...]", key));
    return {};
  }
  rest = rest.substr(1, rest.size() - 2);
  std::vector<double> numbers;
  while (!Trim(rest).empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view word = Trim(rest.substr(0, comma));
    const std::optional<double> number = ParseDouble(word);
    if (!number) {
      SourceLocation where = entry.where;
      where.column += static_cast<int>(word.data() - entry.value.data());
      diagnostics->Error(where,
                         fmt::format("'{}' is no number (a list of '{}')", Printable(word), key));
      return {};
    }
    numbers.push_back(*number);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return numbers;
}

}  // namespace

std::optional<UrCalibration> ReadUrCalibration(const std::string& file, Diagnostics* diagnostics) {
  const std::optional<std::string> text = ReadTextFile(file, diagnostics);
  if (!text) return std::nullopt;
  const int errors_before = diagnostics->num_errors();
  const Entries entries = MountingOf(file, *text);
  const auto list = [&](const std::string& key) {
    const auto found = entries.find(key);
    if (found != entries.end()) return ListOf(key, found->second, diagnostics);
    diagnostics->Error({file},
                       fmt::format("has no '{}' in a section [mounting]; the file is called "
                                   "calibration.conf on the robot's controller",
                                   key));
    return std::vector<double>();
  };
  UrCalibration calibration;
  calibration.theta = list("delta_theta");
  calibration.a = list("delta_a");
  calibration.d = list("delta_d");
  calibration.alpha = list("delta_alpha");
  if (diagnostics->num_errors() > errors_before) return std::nullopt;
  return calibration;
}

void AddUrCalibration(const UrCalibration& calibration,
                      const SourceLocation& where,
                      RobotModel* robot,
                      Diagnostics* diagnostics) {
  const struct {
    const char* key;
    const std::vector<double>& deltas;
    double JointRow::*number;
  } lists[] = {{"delta_theta", calibration.theta, &JointRow::theta},
               {"delta_a", calibration.a, &JointRow::a},
               {"delta_d", calibration.d, &JointRow::d},
               {"delta_alpha", calibration.alpha, &JointRow::alpha}};
  for (const auto& list : lists) {
    if (list.deltas.size() != robot->joints.size()) {
      diagnostics->Error(where,
                         fmt::format("'{}' has {} numbers, but the robot has {} joints",
                                     list.key,
                                     list.deltas.size(),
                                     robot->joints.size()));
      continue;
    }
    for (std::size_t j = 0; j < list.deltas.size(); ++j) {
      robot->joints[j].*list.number += list.deltas[j];
    }
  }
}

}  // namespace dhcal
