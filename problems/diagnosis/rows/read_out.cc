#include "problems/diagnosis/rows/read_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "problems/diagnosis/tuning.h"

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

/// Rows of one group of a vector's or matrix' rows put together by `Put` (mean or median).
MatrixXd Grouped(const MatrixXd& values, const std::vector<std::vector<int>>& groups, bool median) {
  if (values.rows() == 0) return values;
  MatrixXd grouped(static_cast<Index>(groups.size()), values.cols());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Index k = 0; k < values.cols(); ++k) {
      std::vector<double> of_group;
      for (const int row : groups[g]) {
        if (std::isfinite(values(row, k))) of_group.push_back(values(row, k));
      }
      double mean = 0;
      for (const double value : of_group) mean += value / static_cast<double>(of_group.size());
      grouped(static_cast<Index>(g), k) = of_group.empty() ? std::nan("")
                                          : median         ? Median(of_group)
                                                           : mean;
    }
  }
  return grouped;
}

template <typename T>
std::vector<T> Firsts(const std::vector<T>& values, const std::vector<std::vector<int>>& groups) {
  std::vector<T> firsts;
  if (values.empty()) return firsts;
  for (const auto& group : groups) {
    firsts.push_back(values[static_cast<std::size_t>(group.front())]);
  }
  return firsts;
}

Recording PutTogether(const Recording& r,
                      const std::vector<std::vector<int>>& groups,
                      const MatrixXd& direction) {
  Recording t = r;
  // A pose begins with its first reading: an instant that separates poses separates their readings.
  t.numbers.resize(static_cast<Index>(groups.size()));
  t.time.resize(r.time.size() > 0 ? t.numbers.size() : 0);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto at = static_cast<Index>(k);
    t.numbers[at] = groups[k].front();
    if (t.time.size() > 0) t.time[at] = r.time[groups[k].front()];
  }
  t.lines = Firsts(r.lines, groups);
  t.q = Grouped(r.q, groups, false);
  t.p_WQ = Grouped(r.p_WQ, groups, true);
  t.quaternion = Grouped(r.quaternion, groups, false);
  for (Index k = 0; k < t.quaternion.rows(); ++k) t.quaternion.row(k).normalize();
  t.distance = Grouped(r.distance, groups, true);
  t.head = Grouped(r.head, groups, true);
  t.sigma = Grouped(r.sigma, groups, false);
  t.payload = Grouped(r.payload, groups, false);
  t.temperature = Grouped(r.temperature, groups, false);
  t.direction = Grouped(direction, groups, true);
  t.speed = Grouped(r.speed, groups, false);
  t.torque = Grouped(r.torque, groups, false);
  t.run_idx = Firsts(r.run_idx, groups);
  t.target_idx = Firsts(r.target_idx, groups);
  t.anchor_idx = Firsts(r.anchor_idx, groups);
  t.edge_idx = Firsts(r.edge_idx, groups);
  t.is_test = Firsts(r.is_test, groups);
  for (std::size_t k = 0; k < r.extra.size(); ++k) {
    t.extra[k].values = Grouped(r.extra[k].values, groups, false);
  }
  return t;
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

DistinctRows PutRepeatsTogether(const Recording& recording, const MatrixXd& direction) {
  const std::vector<int> poses = PosesOfRows(recording);
  std::map<std::vector<double>, std::size_t> known;
  DistinctRows distinct;
  for (int row = 0; row < recording.num_rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    std::vector<double> key = {static_cast<double>(poses[at]),
                               static_cast<double>(recording.run(row)),
                               static_cast<double>(recording.target(row)),
                               static_cast<double>(recording.edge(row)),
                               recording.test(row) ? 1.0 : 0.0,
                               recording.payload.size() > 0 && std::isfinite(recording.payload[row])
                                   ? recording.payload[row]
                                   : -1.0,
                               recording.anchor_idx.empty() ? 0.0 : recording.anchor_idx[at] + 1.0};
    const auto place = known.emplace(key, distinct.original.size());
    if (place.second) distinct.original.emplace_back();
    distinct.original[place.first->second].push_back(row);
  }
  const auto rows = static_cast<double>(recording.num_rows());
  const bool displaced = recording.displacement.rows() > 0;
  if (displaced || static_cast<double>(known.size()) > kTuning.repeats_share * rows) {
    distinct.recording = recording;
    distinct.original.clear();
    for (int row = 0; row < recording.num_rows(); ++row) distinct.original.push_back({row});
    return distinct;
  }
  distinct.averaged = true;
  distinct.recording = PutTogether(recording, distinct.original, direction);
  return distinct;
}

}  // namespace dhcal
