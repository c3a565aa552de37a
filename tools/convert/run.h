// A whole run of dhcal_convert.
#ifndef DHCAL_TOOLS_CONVERT_RUN_H_
#define DHCAL_TOOLS_CONVERT_RUN_H_

#include <ostream>
#include <string>

namespace dhcal {

constexpr int kConvertOk = 0;
constexpr int kConvertFailed = 1;
constexpr int kConvertBadInput = 2;

/// As the command line has them; empty = not given.
struct ConvertOptions {
  std::string from, to;
  std::string base_link, tip_link;  // of a URDF
  std::string urdf;                 // the file that corrections are written into
  std::string nominal;              // the rows that a calibration.conf corrects
  std::string convention;           // standard or modified
  std::string kind;                 // of `to`: robot, urdf, ros_kinematics
  std::string hash;                 // of ros_kinematics
  std::string data_dir;
};

/// Exit status. Messages go to `messages`; the file appears whole or not at all.
int RunConvert(const ConvertOptions& options, std::ostream& messages);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_CONVERT_RUN_H_
