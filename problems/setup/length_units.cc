#include "problems/setup/length_units.h"

#include <cmath>

namespace dhcal {
namespace {

constexpr double kInch = 25.4;                              // [mm]
constexpr double kSmallestReach = 0.1, kLargestReach = 30;  // [m] of arms

bool Near(double a, double b) { return std::abs(a / b - 1) < 1e-6; }

}  // namespace

double TableReach(const RobotModel& robot) {
  double reach = 0;
  for (const JointRow& row : robot.joints) reach += std::hypot(row.a, row.d);
  return reach;
}

bool TableIsWrong(const RobotModel& robot, double ratio) {
  if (Near(ratio, kInch) || Near(ratio, kInch / 1000)) return false;
  if (Near(ratio, 1 / kInch) || Near(ratio, 1000 / kInch)) return true;
  const double reach = TableReach(robot);
  return reach < kSmallestReach || reach > kLargestReach;
}

LengthUnitWords WordsOfLengthUnit(double factor) {
  if (Near(factor, 1000)) return {"metres", "_mm", "_m"};
  if (Near(factor, 1e-3)) return {"millimetres", "_m", "_mm"};
  if (Near(factor, kInch)) return {"inches", "_mm", ""};
  return {"inches", "_m", ""};
}

}  // namespace dhcal
