#include "problems/setup/words.h"

#include <fmt/format.h>

#include "core/base/units.h"

namespace dhcal {

std::string JointList(const Files& files, const std::vector<int>& joints) {
  std::string numbers, names;
  bool own_names = false;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::string& name = files.robot().joints[static_cast<std::size_t>(joints[k])].name;
    own_names = own_names || name != fmt::format("J{}", joints[k] + 1);
    const char* const separator = k == 0 ? "" : k + 1 == joints.size() ? " and " : ", ";
    numbers += separator + std::to_string(joints[k] + 1);
    names += separator + name;
  }
  return fmt::format("{} {}{}",
                     joints.size() == 1 ? "joint" : "joints",
                     numbers,
                     own_names ? " (" + names + ")" : "");
}

std::string JointColumn(const Files& files, int column) {
  const auto idx = static_cast<std::size_t>(column);
  if (idx < files.recording.q_names.size()) return files.recording.q_names[idx];
  return fmt::format("q{}_{}", column + 1, files.revolute(column) ? "rad" : "m");
}

std::string InMillimetres(double length) {
  const double mm = length / kMillimetre;
  return fmt::format("{:.{}f} mm", mm, mm < 10 ? 2 : mm < 100 ? 1 : 0);
}

SourceLocation HeaderWhere(const Files& files) {
  return {files.recording.file, files.recording.header_line, 0};
}

}  // namespace dhcal
