#include "problems/setup/lint.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

using Remarks = std::vector<std::string>;

/// Joints whose geometry a recording hardly shows: those that stand still, and those that move by
/// less than a joint must for its lever to be told from a constant.
void Ranges(const Files& files, Remarks* remarks) {
  constexpr double kStill = 0.1 * kDegree, kStillSlide = 0.1 * kMillimetre;
  constexpr double kNarrow = 15 * kDegree, kNarrowSlide = 20 * kMillimetre;
  std::vector<int> still, narrow;
  double widest = 0;
  for (int j = 0; j < files.num_joints(); ++j) {
    const Eigen::VectorXd q = files.recording.q.col(j);
    const double range = q.maxCoeff() - q.minCoeff();
    const bool turns = files.revolute(j);
    if (range < (turns ? kStill : kStillSlide)) {
      still.push_back(j);
    } else if (range < (turns ? kNarrow : kNarrowSlide)) {
      narrow.push_back(j);
      if (turns) widest = std::max(widest, range);
    }
  }
  const bool all_still = static_cast<int>(still.size()) == files.num_joints();
  if (!still.empty() && !all_still) {
    remarks->push_back(fmt::format(
        "J{} {} still in all rows: what depends on {} motion cannot be determined. Record poses in "
        "which {}.",
        JointList(files, still).substr(1),
        still.size() == 1 ? "stands" : "stand",
        still.size() == 1 ? "its" : "their",
        still.size() == 1 ? "it moves" : "they move"));
  }
  if (!narrow.empty()) {
    remarks->push_back(fmt::format(
        "J{} {} over{}: much of the geometry cannot be determined from so little, and nothing is "
        "known beyond. Record poses over much of the range.",
        JointList(files, narrow).substr(1),
        narrow.size() == 1 ? "moves" : "move",
        widest > 0 ? fmt::format(" at most {:.2g} deg", widest / kDegree) : " a few mm only"));
  }
}

void Repeats(const Recording& recording, Remarks* remarks) {
  const std::vector<int> poses = PosesOfRows(recording);
  const std::size_t distinct = std::set<int>(poses.begin(), poses.end()).size();
  if (distinct == poses.size() || distinct > poses.size() * 4 / 5) return;
  remarks->push_back(
      fmt::format("The {} rows are of {} distinct poses (equal joint coordinates): repeats of a "
                  "pose tell of the "
                  "noise, not of the robot.",
                  poses.size(),
                  distinct));
}

void Times(const Recording& recording, Remarks* remarks) {
  constexpr double kLongest = 10 * 365.25 * 86400;  // [s] no recording takes ten years
  const Eigen::VectorXd& t = recording.time;
  int backwards = 0;
  for (Eigen::Index row = 1; row < t.size(); ++row) {
    const bool same_run =
        recording.run(static_cast<int>(row)) == recording.run(static_cast<int>(row) - 1);
    if (same_run && t[row] < t[row - 1]) ++backwards;
  }
  if (backwards > 0) {
    remarks->push_back(
        fmt::format("The time t_s runs backwards {} inside a run: sort the rows by time, or give "
                    "the runs names "
                    "in a column run.",
                    backwards == 1 ? "once" : fmt::format("{} times", backwards)));
  }
  if (t.size() > 1 && t.allFinite() && t.maxCoeff() - t.minCoeff() > kLongest) {
    remarks->push_back(fmt::format(
        "The time t_s spans {:.2g} years: is it in seconds? Effects of time are judged by it.",
        (t.maxCoeff() - t.minCoeff()) / (365.25 * 86400)));
  }
}

/// 1.5708 under the name of degrees is pi/2.
void Twists(const Files& files, Remarks* remarks) {
  for (const JointRow& row : files.robot().joints) {
    for (const double turn : {kPi / 2, kPi}) {
      if (std::abs(std::abs(row.alpha) / kDegree - turn) > 1e-3) continue;
      remarks->push_back(fmt::format(
          "{}alpha of {} is {:.5g} deg, which is the number of {} in radians: if it is meant in "
          "radians, write alpha_rad.",
          row.where.line > 0 ? row.where.ToString() + ": " : std::string(),
          row.name,
          row.alpha / kDegree,
          turn < 3 ? "pi/2" : "pi"));
      return;
    }
  }
}

/// Gravity is stated in the base's frame.
void Gravity(const Files& files, Remarks* remarks) {
  constexpr double kTilted = 3 * kDegree;
  const RobotModel& robot = files.robot();
  if (robot.links.empty()) return;
  const Eigen::Vector3d up = robot.X_WB.linear().col(2);
  const double tilt = std::acos(std::clamp(up.z(), -1.0, 1.0));
  const Eigen::Vector3d g = robot.gravity_B;
  const bool along_axis = g.head<2>().norm() < 1e-6 * g.norm();
  const Eigen::Vector3d g_W = robot.X_WB.linear() * g;
  const double off = std::acos(std::clamp(-g_W.z() / g.norm(), -1.0, 1.0));
  if (tilt < kTilted || off < kTilted || !along_axis) return;
  remarks->push_back(fmt::format(
      "The base is tilted by {:.1f} deg against the measurement frame, but gravity_m_s2 is along "
      "the base's z axis: if the measurement frame is level, state gravity in the base's frame.",
      tilt / kDegree));
}

}  // namespace

std::vector<std::string> Lint(const ProblemSpec& spec, const Recording& recording) {
  const Files files{spec, recording};
  Remarks remarks;
  if (recording.num_rows() == 0) return remarks;
  Ranges(files, &remarks);
  Repeats(recording, &remarks);
  Times(recording, &remarks);
  Twists(files, &remarks);
  Gravity(files, &remarks);
  return remarks;
}

}  // namespace dhcal
