#include "problems/setup/length_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dhcal {
namespace {

constexpr double kInch = 25.4;     // [mm]
constexpr double kNearUnit = 0.1;  // of a factor: no robot is so much larger than its table
constexpr double kSmallestReach = 0.1, kLargestReach = 30;  // [m] of arms

bool Near(double a, double b) { return std::abs(a / b - 1) < 1e-6; }

}  // namespace

double TableReach(const RobotModel& robot) {
  double reach = 0;
  for (const JointRow& row : robot.joints) reach += std::hypot(row.a, row.d);
  return reach;
}

double ReachOf(const RobotModel& robot) {
  return std::clamp(TableReach(robot), kSmallestReach, kLargestReach);
}

std::optional<LengthFactors> UnitsOf(const RobotModel& robot, double ratio) {
  constexpr std::array<double, 5> kReadings = {1, 1000, 1e-3, kInch, kInch / 1000};
  const double reach = TableReach(robot);
  // Where the arm's size is none, the table is wrong, whatever the readings are.
  std::vector<double> tables = {1, kInch, kInch / 1000};
  if (reach > kLargestReach) tables = {1e-3};
  if (reach < kSmallestReach) tables = {1e3, kInch};
  for (const double table : tables) {
    for (const double readings : kReadings) {
      if (std::abs(table * ratio / readings - 1) < kNearUnit) return LengthFactors{table, readings};
    }
  }
  return std::nullopt;
}

double ToolScale(const RobotModel& robot, const Eigen::Vector3d& p_TQ) {
  constexpr double kAlike = 0.3;       // of the length
  constexpr double kLongestTool = 10;  // reaches
  if (!robot.targets.empty()) return 1;
  const Eigen::Vector3d stated = robot.X_TQ.translation();
  // Parallel axes do not show all of a tool, and a turned flange turns it: none is that long.
  const double reach = ReachOf(robot);
  if (stated.norm() > kLongestTool * reach && stated.norm() < reach / 1e-3) return 1e-3;
  for (const double scale : {1e-3, 1e3}) {
    const Eigen::Vector3d meant = scale * stated;
    if (!meant.isZero(0) && (meant - p_TQ).norm() < kAlike * meant.norm()) return scale;
  }
  return 1;
}

LengthUnitWords WordsOfLengthUnit(double factor) {
  if (Near(factor, 1000)) return {"metres", "_mm", "_m"};
  if (Near(factor, 1e-3)) return {"millimetres", "_m", "_mm"};
  if (Near(factor, kInch)) return {"inches", "_mm", ""};
  return {"inches", "_m", ""};
}

}  // namespace dhcal
