// Words that several kinds of causes share.
#ifndef DHCAL_PROBLEMS_SETUP_WORDS_H_
#define DHCAL_PROBLEMS_SETUP_WORDS_H_

#include <string>
#include <vector>

#include "problems/setup/cause.h"

namespace dhcal {

/// "joint 2", "joints 2 and 6", "joints 1, 2 and 3"; indices from 0. Where the file names joints
/// otherwise than J1, J2, ..., their names follow.
std::string JointList(const Files& files, const std::vector<int>& joints);

/// "q1_deg": as the recording has it, or with the first unit of the format.
std::string JointColumn(const Files& files, int column);

/// "0.70 mm", "31.7 mm", "1091 mm": digits enough to compare.
std::string InMillimetres(double length);

/// Of the recording's header.
SourceLocation HeaderWhere(const Files& files);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_WORDS_H_
