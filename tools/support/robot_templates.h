// The problem files of common robots that come with the program, and where they lie.
#ifndef DHCAL_TOOLS_SUPPORT_ROBOT_TEMPLATES_H_
#define DHCAL_TOOLS_SUPPORT_ROBOT_TEMPLATES_H_

#include <string>
#include <vector>

namespace dhcal {

/// The folder of the templates: share/ceres_dhcal/robots of the prefix in which the running program
/// is installed, or else problems/robots of the source tree that it was built from. "" where
/// neither is there.
std::string RobotTemplatesFolder();

/// Their names in alphabetical order, "ur5e" for ur5e.yaml.
std::vector<std::string> RobotTemplateNames(const std::string& folder);

/// The file of a template.
std::string RobotTemplateFile(const std::string& folder, const std::string& name);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_ROBOT_TEMPLATES_H_
