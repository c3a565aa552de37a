#include "core/model/robot.h"

#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace dhcal {

std::string JointWords(const RobotModel& robot, int joint_from_1) {
  std::string words = fmt::format("joint {}", joint_from_1);
  if (joint_from_1 < 1 || joint_from_1 > robot.num_joints()) return words;
  const std::string& name = robot.joints[static_cast<std::size_t>(joint_from_1 - 1)].name;
  const std::string number = std::to_string(joint_from_1);
  // "A2", "joint_2" of the second: the number again.
  const std::size_t digits = name.find_first_of("0123456789");
  if (name.empty() || (digits != std::string::npos && name.substr(digits) == number)) return words;
  return fmt::format("{} ({})", words, name);
}

}  // namespace dhcal
