#include "problems/diagnosis/rows/oddities.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/read_out.h"

namespace dhcal {
namespace {

constexpr double kFarApart = 0.5;      // of how far the row lies off
constexpr double kSameReading = 1e-9;  // [m]
constexpr double kRoundLength = 5e-3;  // [m] a slip of the fixture is a whole number of these ...
constexpr double kNearlyRound = 0.02;  // ... to this part

/// What was read of a row, as one vector; empty where nothing was, or a displacement, which says
/// little by itself.
Eigen::VectorXd ReadingOf(const Recording& r, int row) {
  if (r.displacement.rows() > 0) return {};
  if (r.p_WQ.rows() > 0) return r.p_WQ.row(row);
  if (r.head.rows() > 0) return r.head.row(row);
  if (r.distance.size() > 0) return r.distance.segment<1>(row);
  return {};
}

/// The row before of the same target, anchor and edge; -1 = none.
int RowBefore(const Recording& r, int row) {
  for (int before = row - 1; before >= 0; --before) {
    const bool same_anchor =
        r.anchor_idx.empty() || r.anchor_idx[static_cast<std::size_t>(row)] ==
                                    r.anchor_idx[static_cast<std::size_t>(before)];
    const bool same_series = r.run(before) == r.run(row) && r.target(before) == r.target(row) &&
                             r.edge(before) == r.edge(row);
    if (same_series && same_anchor) return before;
  }
  return -1;
}

std::string Oddity(const Recording& r, const std::vector<int>& poses, int row, double size) {
  const Eigen::VectorXd reading = ReadingOf(r, row);
  if (reading.size() > 0 && reading.isZero(0)) return "all that was read is zero";
  if (r.q.row(row).isZero(0)) return "all joint coordinates are zero";
  const int before = RowBefore(r, row);
  if (before >= 0) {
    const Eigen::VectorXd other = ReadingOf(r, before);
    const auto pose = [&](int k) { return poses[static_cast<std::size_t>(k)]; };
    const bool same_reading =
        reading.size() > 0 && (reading - other).lpNorm<Eigen::Infinity>() < kSameReading;
    if (same_reading && pose(before) != pose(row)) {
      return fmt::format("its reading repeats that of row {}, though the joints have moved",
                         before + 1);
    }
    const bool differs = reading.size() > 0 && (reading - other).norm() > kFarApart * size;
    if (differs && pose(before) == pose(row)) {
      return fmt::format("its joint coordinates repeat those of row {}, though the reading differs",
                         before + 1);
    }
  }
  const double lengths = size / kRoundLength;
  if (lengths > 1 - kNearlyRound && std::abs(lengths - std::round(lengths)) < kNearlyRound &&
      std::round(lengths) >= 1) {
    return fmt::format("it lies a round length off, {:.1f} mm", size / kMillimetre);
  }
  return std::isnan(size) ? "it lies far off" : "it lies far off; nothing else about it is odd";
}

}  // namespace

std::vector<RowSetAside> DescribeSetAside(const Recording& recording,
                                          const std::vector<int>& rows,
                                          std::vector<RowResidual>* residuals) {
  std::vector<RowSetAside> described;
  if (rows.empty()) return described;
  std::map<int, RowResidual*> of_row;
  for (RowResidual& residual : *residuals) of_row[residual.row_idx] = &residual;
  const std::vector<int> poses = PosesOfRows(recording);
  for (const int row : rows) {
    RowSetAside entry;
    entry.row_idx = row;
    entry.test = recording.test(row);
    const auto found = of_row.find(row);
    if (found != of_row.end()) entry.size = found->second->length;
    entry.reason = Oddity(recording, poses, row, entry.size);
    if (found != of_row.end()) found->second->set_aside = entry.reason;
    described.push_back(entry);
  }
  return described;
}

}  // namespace dhcal
