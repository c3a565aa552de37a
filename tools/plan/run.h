// A whole run of dhcal_plan.
#ifndef DHCAL_TOOLS_PLAN_RUN_H_
#define DHCAL_TOOLS_PLAN_RUN_H_

#include <ostream>
#include <string>

#include "problems/plan/plan.h"

namespace dhcal {

constexpr int kPlanOk = 0;
constexpr int kPlanFailed = 1;
constexpr int kPlanBadInput = 2;

/// As the command line has them; empty = not given.
struct PlanCommand {
  std::string problem, out, data_dir;
  std::string poses, candidates, criterion, seed;
  std::string volume;  // "0.8,-0.5,0.2,1.5,0.5,1.2"
  bool split = false;
  std::string result;  // result.json whose alternatives are to be split
  std::string edge_length, edge_poses, tilt, slope, stand_off;
};

/// Exit status. The poses go to the file `command.out` as a whole, what they are good for to
/// `out`; messages to `messages`.
int RunPlan(const PlanCommand& command, std::ostream& out, std::ostream& messages);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PLAN_RUN_H_
