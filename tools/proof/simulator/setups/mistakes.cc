#include "tools/proof/simulator/setups/mistakes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/units.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<int> Turning(const Arm& arm) {
  std::vector<int> joints;
  for (int j = 0; j < arm.num_joints(); ++j) {
    if (!arm.links[static_cast<std::size_t>(j)].slides) joints.push_back(j);
  }
  return joints;
}

void Write(const std::string& kind, std::vector<int> joints, WrongFiles* files) {
  std::sort(joints.begin(), joints.end());
  for (int& joint : joints) ++joint;
  files->mistakes.push_back({kind, joints});
}

/// Up to `most` different ones.
std::vector<int> DrawSome(std::vector<int> from, int most, Rng* rng) {
  const int count = 1 + DrawInt(most, rng);
  std::vector<int> some;
  while (static_cast<int>(some.size()) < count && !from.empty()) {
    const int k = DrawInt(static_cast<int>(from.size()), rng);
    some.push_back(from[static_cast<std::size_t>(k)]);
    from.erase(from.begin() + k);
  }
  return some;
}

/// The file's coordinate is another one than the table's: q_table = q_file + f q_driver.
void Couple(WrongFiles* files, Rng* rng) {
  const int n = files->table.num_joints();
  const std::vector<std::pair<int, int>> pairs = {{2, 1}, {n - 2, n - 3}, {n - 1, n - 2}};
  const auto [joint, driver] = DrawFrom(pairs, rng);
  files->q.col(joint) -= DrawSign(rng) * files->q.col(driver);
  files->mistakes.push_back({"coupling", {joint + 1, driver + 1}});
}

void CountTheOtherWay(WrongFiles* files, Rng* rng) {
  const std::vector<int> joints = DrawSome(Turning(files->table), 3, rng);
  for (const int j : joints) files->q.col(j) *= -1;
  Write("joint_sense", joints, files);
}

void MoveZero(WrongFiles* files, Rng* rng) {
  const std::vector<int> joints = DrawSome(Turning(files->table), 1, rng);
  for (const int j : joints) {
    files->q.col(j).array() += kPi / 2 * DrawOther({-1, 1, 2}, 0, rng);
  }
  Write("zero_offset", joints, files);
}

/// A joint whose mastering was lost.
void Master(WrongFiles* files, Rng* rng) {
  const std::vector<int> joints = DrawSome(Turning(files->table), 1, rng);
  for (const int j : joints) {
    files->q.col(j).array() += DrawSign(rng) * rng->Uniform(3, 60) * kDegree;
  }
  Write("zero_offset", joints, files);
}

void Reorder(WrongFiles* files, Rng* rng) {
  std::vector<int> turning = Turning(files->table), order = turning;
  switch (DrawInt(3, rng)) {
    case 0: {  // two of them
      const std::vector<int> two = DrawSome(turning, 1, rng);
      const auto at = static_cast<std::size_t>(std::find(turning.begin(), turning.end(), two[0]) -
                                               turning.begin());
      std::swap(
          order[at],
          order[(at + 1 +
                 static_cast<std::size_t>(DrawInt(static_cast<int>(turning.size()) - 1, rng))) %
                turning.size()]);
      break;
    }
    case 1:
      std::reverse(order.begin(), order.end());
      break;
    default:  // by the alphabet: elbow, lift, pan, then the wrist
      std::reverse(order.begin(), order.begin() + 3);
  }
  const MatrixXd q = files->q;
  std::vector<int> moved;
  for (std::size_t k = 0; k < order.size(); ++k) {
    files->q.col(turning[k]) = q.col(order[k]);
    if (turning[k] != order[k]) moved.push_back(turning[k]);
  }
  Write("joint_order", moved, files);
}

void MisnameJointUnit(WrongFiles* files, Rng* rng) {
  std::vector<int> joints = Turning(files->table);
  const bool wrist = joints.size() > 4 && Chance(0.4, rng);
  if (wrist) joints.erase(joints.begin(), joints.end() - 3);
  const bool radians = Chance(0.7, rng);
  for (const int j : joints) {
    const auto idx = static_cast<std::size_t>(j);
    files->joint_unit[idx] = radians ? 1 : 1 / kDegree;
    files->joint_ending[idx] = radians ? "deg" : "rad";
  }
  Write("unit", joints, files);
}

void MisnameReadings(WrongFiles* files, Rng* rng) {
  switch (DrawInt(3, rng)) {
    case 0:
      files->reading_unit = 1;
      break;
    case 1:
      files->reading_unit = 1 / 0.0254;
      break;
    default:
      files->reading_unit = 1e3;
      files->reading_ending = "m";
  }
  Write("unit", {}, files);
}

void Mirror(WrongFiles* files, Rng* rng) {
  const int axis = DrawInt(3, rng);
  if (Chance(0.5, rng)) {
    files->readings.col(axis) *= -1;
  } else {
    files->readings.col(axis).swap(files->readings.col((axis + 1) % 3));
  }
  Write("mirrored_frame", {}, files);
}

void ReorderQuaternion(WrongFiles* files, Rng* rng) {
  if (Chance(0.6, rng)) {
    files->quaternion = {1, 2, 3, 0};
  } else {
    files->readings.rightCols<3>() *= -1;
  }
  Write("quaternion", {}, files);
}

/// From a row on, the reading of the next pose, or of the one before.
void ShiftRows(WrongFiles* files, Rng* rng) {
  const Index n = files->readings.rows();
  const Index from = Chance(0.5, rng) ? 0 : n / 5 + DrawInt(static_cast<int>(3 * n / 5), rng);
  const MatrixXd right = files->readings;
  const int by = Chance(0.5, rng) ? 1 : -1;
  for (Index row = from; row < n; ++row) {
    files->readings.row(row) = right.row(std::clamp<Index>(row + by, from, n - 1));
  }
  Write("row_shift", {}, files);
}

}  // namespace

std::vector<MistakeSource> MistakeSources(const WrongFiles& files) {
  const Settings& s = files.trial.settings;
  const bool points = s.kind != Kind::kDistance;
  const bool six = files.table.num_joints() >= 6;
  const auto table_unit = [](WrongFiles* wrong, Rng* /*rng*/) {
    wrong->angle_unit = 1;
    Write("unit", {}, wrong);
  };
  const auto lengths = [](WrongFiles* wrong, Rng* rng) {
    wrong->length_unit = Chance(0.5, rng) ? 1e3 : 1e-3;
    Write("unit", {}, wrong);
  };
  const auto tool = [](WrongFiles* wrong, Rng* /*rng*/) {
    wrong->tool_unit = 1e3;
    Write("unit", {}, wrong);
  };
  const auto convention = [](WrongFiles* wrong, Rng* /*rng*/) {
    Convention& c = wrong->table.convention;
    c = c == Convention::kStandard ? Convention::kModified : Convention::kStandard;
    Write("convention", {}, wrong);
  };
  return {{"coupling", six, Couple},
          {"joint_sense", true, CountTheOtherWay},
          {"zero_offset", true, MoveZero},
          {"mastering", true, Master},
          {"joint_order", true, Reorder},
          {"joint unit", true, MisnameJointUnit},
          {"table unit", true, table_unit},
          {"table lengths", true, lengths},
          {"tool lengths", true, tool},
          {"convention", true, convention},
          {"reading unit", points, MisnameReadings},
          {"mirrored_frame", points && s.kind != Kind::kPose, Mirror},
          {"quaternion", s.kind == Kind::kPose, ReorderQuaternion},
          {"row_shift", s.kind == Kind::kPosition, ShiftRows}};
}

}  // namespace dhcal::concealed
