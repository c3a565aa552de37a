#include "tools/support/robot_templates.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace dhcal {
namespace {

namespace fs = std::filesystem;

/// Relative to the program, so that an installed tree may be moved.
fs::path Installed() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return DHCAL_INSTALLED_ROBOTS;
  return program.parent_path().parent_path() / "share/ceres_dhcal/robots";
}

}  // namespace

std::string RobotTemplatesFolder() {
  for (const fs::path& folder :
       {Installed(), fs::path(DHCAL_INSTALLED_ROBOTS), fs::path(DHCAL_SOURCE_ROBOTS)}) {
    std::error_code error;
    if (fs::is_directory(folder, error)) return folder.string();
  }
  return "";
}

std::vector<std::string> RobotTemplateNames(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string RobotTemplateFile(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / (name + ".yaml")).string();
}

}  // namespace dhcal
