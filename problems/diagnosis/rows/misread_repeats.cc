#include "problems/diagnosis/rows/misread_repeats.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/statistics.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kFewestToVote = 3;  // repeats that can outvote one
// Times the median of what repeats are off; of three, that is 0.8 standard deviations, and no
// normal noise is off by seven.
constexpr double kFarOff = 9;

/// Adds the rows whose values (rows x coordinates) are far from their pose's.
void AddMisread(const MatrixXd& values,
                const MatrixXd& of_pose,
                const std::vector<std::vector<int>>& original,
                std::set<int>* misread) {
  if (values.rows() == 0) return;
  std::vector<double> off;
  const auto visit = [&](const auto& see) {
    for (std::size_t pose = 0; pose < original.size(); ++pose) {
      if (original[pose].size() < kFewestToVote) continue;
      for (const int row : original[pose]) {
        for (Index k = 0; k < values.cols(); ++k) {
          const double by = std::abs(values(row, k) - of_pose(static_cast<Index>(pose), k));
          if (by > 0) see(row, by);  // NaN: not read
        }
      }
    }
  };
  visit([&](int, double by) { off.push_back(by); });
  if (off.empty()) return;
  const double usual = Median(off);
  visit([&](int row, double by) {
    if (by > kFarOff * usual) misread->insert(row);
  });
}

}  // namespace

std::vector<int> MisreadRepeats(const Recording& recorded, const DistinctRows& distinct) {
  if (!distinct.averaged) return {};
  std::set<int> misread;
  const Recording& poses = distinct.recording;
  AddMisread(recorded.p_WQ, poses.p_WQ, distinct.original, &misread);
  AddMisread(recorded.distance, poses.distance, distinct.original, &misread);
  AddMisread(recorded.head, poses.head, distinct.original, &misread);
  return {misread.begin(), misread.end()};
}

}  // namespace dhcal
