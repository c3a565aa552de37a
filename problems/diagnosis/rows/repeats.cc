#include "problems/diagnosis/rows/repeats.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/rng.h"
#include "core/math/statistics.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

using Rows = std::vector<int>;

constexpr std::size_t kFewestOfAPose = 4;  // fewer have too few orders to tell one by
constexpr int kShuffles = 200;
constexpr double kFarBelow = 3;  // standard deviations of the shuffled: once in 700
constexpr double kWildest = 7;   // of a deviation, in medians of all: an outlier is no course

/// A vector's or matrix' rows put together by groups: medians, or means.
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

/// What tells a row's pose from another: rows that differ in it are no repeats.
std::vector<double> KeyOf(const Recording& r, int row, int pose) {
  const auto at = static_cast<std::size_t>(row);
  const bool loaded = r.payload.size() > 0 && std::isfinite(r.payload[row]);
  return {static_cast<double>(pose),
          static_cast<double>(r.run(row)),
          static_cast<double>(r.target(row)),
          static_cast<double>(r.edge(row)),
          r.test(row) ? 1.0 : 0.0,
          loaded ? r.payload[row] : -1.0,
          r.anchor_idx.empty() ? 0.0 : r.anchor_idx[at] + 1.0};
}

/// Rows of the same key, each pose's in their order.
std::vector<Rows> RowsOfPoses(const Recording& recording, const std::vector<int>& poses) {
  std::map<std::vector<double>, std::size_t> known;
  std::vector<Rows> rows;
  for (int row = 0; row < recording.num_rows(); ++row) {
    const auto key = KeyOf(recording, row, poses[static_cast<std::size_t>(row)]);
    const auto place = known.emplace(key, rows.size());
    if (place.second) rows.emplace_back();
    rows[place.first->second].push_back(row);
  }
  return rows;
}

/// Which visit to a pose a row belongs to: a new one begins where the row before is of another.
std::vector<int> VisitsOf(const std::vector<int>& poses) {
  std::vector<int> visits;
  for (std::size_t row = 0; row < poses.size(); ++row) {
    visits.push_back(row == 0                       ? 0
                     : poses[row] == poses[row - 1] ? visits.back()
                                                    : visits.back() + 1);
  }
  return visits;
}

/// The rows of each pose by visits, and the numbers of each pose's visits among them.
struct PoseVisits {
  std::vector<Rows> rows;
  std::vector<Rows> of_pose;
};

PoseVisits SplitByVisit(const std::vector<Rows>& rows_of_poses, const std::vector<int>& visit_of) {
  PoseVisits visits;
  for (const Rows& rows : rows_of_poses) {
    visits.of_pose.emplace_back();
    int last = -1;
    for (const int row : rows) {
      const int visit = visit_of[static_cast<std::size_t>(row)];
      if (visit != last) {
        visits.of_pose.back().push_back(static_cast<int>(visits.rows.size()));
        visits.rows.emplace_back();
        last = visit;
      }
      visits.rows.back().push_back(row);
    }
  }
  return visits;
}

/// Squared steps from each visit of a pose to its next, all poses together.
double StepsSquared(const MatrixXd& values, const std::vector<Rows>& visits) {
  double sum = 0;
  for (const Rows& of_pose : visits) {
    for (std::size_t k = 1; k < of_pose.size(); ++k) {
      sum += (values.row(of_pose[k]) - values.row(of_pose[k - 1])).squaredNorm();
    }
  }
  return sum;
}

/// Fisher and Yates.
void Shuffle(Rows* rows, Rng* rng) {
  for (std::size_t k = rows->size(); k > 1; --k) {
    const auto other = static_cast<std::size_t>(rng->Uniform(0, static_cast<double>(k)));
    std::swap((*rows)[k - 1], (*rows)[std::min(other, k - 1)]);
  }
}

/// Deviations of visits from their pose's median, wild ones cut off; blank readings have none.
MatrixXd Deviations(const MatrixXd& values, const std::vector<Rows>& visits) {
  MatrixXd deviations = MatrixXd::Zero(values.rows(), values.cols());
  const MatrixXd center = Grouped(values, visits, true);
  std::vector<double> sizes;
  for (std::size_t pose = 0; pose < visits.size(); ++pose) {
    for (const int row : visits[pose]) {
      for (Index k = 0; k < values.cols(); ++k) {
        const double by = values(row, k) - center(static_cast<Index>(pose), k);
        if (!std::isfinite(by)) continue;
        deviations(row, k) = by;
        if (by != 0) sizes.push_back(std::abs(by));
      }
    }
  }
  if (sizes.empty()) return deviations;
  const double most = kWildest * Median(sizes);
  return deviations.cwiseMax(-most).cwiseMin(most);
}

/// True if visits of the same pose, in their order, differ less from the visit before than visits
/// in no order would (von Neumann's ratio against its permutations): something moved in between.
bool GoesByTheClock(const MatrixXd& values, const std::vector<Rows>& visits) {
  const MatrixXd deviations = Deviations(values, visits);
  const double in_order = StepsSquared(deviations, visits);
  Rng rng(1);
  double mean = 0, squares = 0;
  std::vector<Rows> shuffled = visits;
  for (int k = 0; k < kShuffles; ++k) {
    for (Rows& of_pose : shuffled) Shuffle(&of_pose, &rng);
    const double sum = StepsSquared(deviations, shuffled);
    mean += sum / kShuffles;
    squares += sum * sum / kShuffles;
  }
  return in_order < mean - kFarBelow * std::sqrt(std::max(0.0, squares - mean * mean));
}

/// What was measured, one row per row of the recording.
MatrixXd Readings(const Recording& r) {
  if (r.p_WQ.rows() > 0) return r.p_WQ;
  return r.distance.size() > 0 ? MatrixXd(r.distance) : r.head;
}

/// True if visits to a pose may be put together, too.
bool AreOfOneState(const Recording& recording, const PoseVisits& visits) {
  std::size_t most = 0;
  for (const Rows& of_pose : visits.of_pose) most = std::max(most, of_pose.size());
  if (most < 2) return true;
  if (most < kFewestOfAPose) return false;
  return !GoesByTheClock(Grouped(Readings(recording), visits.rows, true), visits.of_pose);
}

/// The rows of each draw of the robot.
std::vector<Rows> RowsOfDraws(const Recording& recording) {
  const std::vector<int> poses = PosesOfRows(recording);
  std::vector<Rows> rows_of_poses = RowsOfPoses(recording, poses);
  PoseVisits visits = SplitByVisit(rows_of_poses, VisitsOf(poses));
  return AreOfOneState(recording, visits) ? std::move(rows_of_poses) : std::move(visits.rows);
}

}  // namespace

DistinctRows PutRepeatsTogether(const Recording& recording, const MatrixXd& direction) {
  DistinctRows distinct;
  if (recording.displacement.rows() == 0) distinct.original = RowsOfDraws(recording);
  const auto rows = static_cast<double>(recording.num_rows());
  const auto draws = static_cast<double>(distinct.original.size());
  distinct.averaged = draws > 0 && draws <= kTuning.repeats_share * rows;
  if (!distinct.averaged) {
    distinct.recording = recording;
    distinct.original.clear();
    for (int row = 0; row < recording.num_rows(); ++row) distinct.original.push_back({row});
    return distinct;
  }
  // In the order of the recording: the clock may have no other column.
  std::sort(distinct.original.begin(), distinct.original.end());
  distinct.recording = PutTogether(recording, distinct.original, direction);
  return distinct;
}

}  // namespace dhcal
