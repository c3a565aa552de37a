#include "problems/setup/shifted_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "problems/setup/frames_alone.h"
#include "problems/setup/length_units.h"

namespace dhcal {
namespace {

constexpr std::size_t kFewestShifted = 3;  // rows on either side of a shift
constexpr double kCap = 0.05;              // of the reach: what one row may count for

/// Points of all rows of the recording, base and tool from the rows of the piece alone.
Eigen::Matrix3Xd PointsFrom(const Files& files,
                            const SetUp& set_up,
                            const std::vector<Reading>& piece) {
  CuredFiles cured = Cured(files, set_up);
  const int n = files.recording.num_rows();
  cured.recording.set_aside.assign(static_cast<std::size_t>(n), true);
  for (const Reading& reading : piece) {
    const int row = std::clamp(reading.row_idx + set_up.shift, 0, n - 1);
    cured.recording.set_aside[static_cast<std::size_t>(row)] = false;
  }
  return FitFrames(cured.spec, cured.recording).points;
}

}  // namespace

std::optional<SetUp> ShiftedPart(const Files& files,
                                 const Candidate& candidate,
                                 const std::vector<Reading>& piece) {
  if (files.recording.p_WQ.rows() == 0 || files.spec.measurement.kind.pairs) return std::nullopt;
  const Eigen::Matrix3Xd points = PointsFrom(files, candidate.set_up, piece);
  if (points.cols() == 0) return std::nullopt;
  SetUp unshifted = candidate.set_up;
  unshifted.shift = 0;
  const CuredFiles cured = Cured(files, unshifted);
  const Recording& read = cured.recording;
  const int run = read.run(piece.front().row_idx);
  const double reach = ReachOf(cured.spec.robot);
  const double cap = kCap * reach;
  // [m] how far the reading of a row lies from the point of the row so many later.
  const auto off = [&](int row, int shift) {
    const int of = row + shift;
    if (!read.p_WQ.row(row).allFinite()) return 0.0;
    if (of < 0 || of >= read.num_rows() || read.run(of) != run) return 0.0;
    return std::min((read.p_WQ.row(row).transpose() - points.col(of)).norm(), cap);
  };
  std::vector<int> rows;
  for (int row = 0; row < read.num_rows(); ++row) {
    if (read.run(row) == run) rows.push_back(row);
  }
  double least = std::numeric_limits<double>::infinity();
  SetUp best = unshifted;
  for (int shift = -kMostRowShift; shift <= kMostRowShift; ++shift) {
    if (shift == 0) continue;
    double sum = 0;
    for (const int row : rows) sum += off(row, shift);
    // The first rows as they are, one more at a time.
    for (std::size_t k = 0; k + kFewestShifted < rows.size(); ++k) {
      if (sum < least && (k == 0 || k >= kFewestShifted)) {
        least = sum;
        best.shift = shift;
        best.shift_from = k == 0 ? 0 : rows[k];
      }
      sum += off(rows[k], 0) - off(rows[k], shift);
    }
  }
  if (!(least <= kNominalFits * reach * static_cast<double>(rows.size()))) {
    return std::nullopt;
  }
  return best;
}

}  // namespace dhcal
