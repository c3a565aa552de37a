#include "problems/diagnosis/rows/read_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/units.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A value is a decimal fraction if it is within so many of its last places of one.
constexpr double kSameDecimal = 1e-6;
constexpr double kSameAngle = 1e-5;  // [rad] or [m] between rows of one pose
constexpr double kNoMotion = 1e-11;  // [rad] or [m]
// Nobody's read-out is coarser: such values were commanded.
constexpr double kCoarsestAngle = 0.2 * kDegree, kCoarsestLength = 0.5 * kMillimetre;
// Nor does anybody round commands to places more coarsely.
constexpr double kCoarsestLevelAngle = 0.02 * kDegree, kCoarsestLevelLength = 0.02 * kMillimetre;
// Distinct values, of those that as many evenly spread readings would have.
constexpr double kShareOfBins = 0.5;
constexpr std::size_t kMostLevels = 40;    // of a joint: beyond, each error is in few rows
constexpr long long kLeastCommonStep = 5;  // quanta between places that fit their last digit

std::set<long long> Places(const VectorXd& values, double quantum) {
  std::set<long long> places;
  for (const double value : values) places.insert(std::llround(value / quantum));
  return places;
}

/// True if values look like readings that were rounded, not like the places of a grid.
bool LooksRead(const VectorXd& values, double quantum, double poses) {
  const double bins = (values.maxCoeff() - values.minCoeff()) / quantum + 1;
  const double expected = bins * -std::expm1(poses * std::log1p(-1 / std::max(bins, 2.0)));
  return static_cast<double>(Places(values, quantum).size()) >= kShareOfBins * expected;
}

/// True if few places look like multiples of a step that the last digit does not hold: those of a
/// grid that fits it have a step in common.
bool LooksRoundedToPlaces(const VectorXd& values, double quantum) {
  const std::set<long long> places = Places(values, quantum);
  if (places.size() < 3 || places.size() > kMostLevels) return false;
  long long step = 0;
  for (const long long place : places) step = std::gcd(step, place - *places.begin());
  return step < kLeastCommonStep;
}

/// Last digit of a joint's column [rad or m]; 0 where it has as many digits as a double.
double LastDigit(const VectorXd& q, bool turns) {
  const double unit = turns ? kDegree : kMillimetre;
  const int decimals = DecimalsOf(q / unit);
  if (decimals < kExactDecimals) return unit * std::pow(10.0, -decimals);
  const int of_radians = turns ? DecimalsOf(q) : kExactDecimals;
  return of_radians < kExactDecimals ? std::pow(10.0, -of_radians) : 0;
}

}  // namespace

int DecimalsOf(const VectorXd& values) {
  for (int decimals = 0; decimals < kExactDecimals; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    const bool all = std::all_of(values.begin(), values.end(), [&](double value) {
      const double scaled = value * scale;
      return std::isnan(value) || std::abs(scaled - std::round(scaled)) < kSameDecimal;
    });
    if (all) return decimals;
  }
  return kExactDecimals;
}

ReadOut ReadOutOf(const Recording& recording, const RobotModel& robot) {
  ReadOut read_out;
  read_out.quantum = VectorXd::Zero(recording.num_joints());
  read_out.level = read_out.quantum;
  const std::vector<int> of_row = PosesOfRows(recording);
  const auto poses = static_cast<double>(std::set<int>(of_row.begin(), of_row.end()).size());
  for (int joint = 0; joint < recording.num_joints(); ++joint) {
    const bool turns = robot.joints[static_cast<std::size_t>(joint)].type == JointType::kRevolute;
    const VectorXd q = recording.q.col(joint);
    // A joint that never moves was not read: it was commanded.
    if (q.size() == 0 || q.maxCoeff() - q.minCoeff() < kNoMotion) continue;
    const double quantum = LastDigit(q, turns);
    if (quantum == 0 || quantum > (turns ? kCoarsestAngle : kCoarsestLength)) continue;
    if (LooksRead(q, quantum, poses)) {
      read_out.quantum[joint] = quantum;
    } else if (quantum <= (turns ? kCoarsestLevelAngle : kCoarsestLevelLength) &&
               LooksRoundedToPlaces(q, quantum)) {
      read_out.level[joint] = quantum;
    }
  }
  return read_out;
}

std::vector<int> PosesOfRows(const Recording& recording) {
  // By the joint that moves most, so that a row is compared with few others.
  Index widest = 0;
  if (recording.num_rows() > 0) {
    (recording.q.colwise().maxCoeff() - recording.q.colwise().minCoeff()).maxCoeff(&widest);
  }
  std::vector<int> order(static_cast<std::size_t>(recording.num_rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return recording.q(a, widest) < recording.q(b, widest);
  });
  std::vector<int> first_of(order.size());  // the row that a row is the same pose as
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int row = order[k];
    first_of[static_cast<std::size_t>(row)] = row;
    for (std::size_t i = k; i-- > 0;) {
      const int other = order[i];
      if (recording.q(row, widest) - recording.q(other, widest) > kSameAngle) break;
      if (!((recording.q.row(row) - recording.q.row(other)).cwiseAbs().maxCoeff() < kSameAngle)) {
        continue;
      }
      first_of[static_cast<std::size_t>(row)] = first_of[static_cast<std::size_t>(other)];
      break;
    }
  }
  std::map<int, int> known;
  std::vector<int> poses;
  for (const int first : first_of) {
    poses.push_back(known.emplace(first, static_cast<int>(known.size())).first->second);
  }
  return poses;
}

}  // namespace dhcal
