#include "problems/diagnosis/hypotheses/hats.h"

#include <algorithm>

namespace dhcal {

Eigen::MatrixXd Hats(const Eigen::VectorXd& values, const std::vector<double>& knots) {
  Eigen::MatrixXd hats =
      Eigen::MatrixXd::Zero(values.size(), static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    const auto above = std::upper_bound(knots.begin(), knots.end(), values[row]);
    const auto right = std::clamp<Eigen::Index>(
        above - knots.begin(), 1, std::max<Eigen::Index>(1, hats.cols() - 1));
    if (hats.cols() == 1) {
      hats(row, 0) = 1;
      continue;
    }
    const double low = knots[static_cast<std::size_t>(right - 1)];
    const double high = knots[static_cast<std::size_t>(right)];
    const double part = std::clamp((values[row] - low) / (high - low), 0.0, 1.0);
    hats(row, right - 1) = 1 - part;
    hats(row, right) = part;
  }
  return hats;
}

}  // namespace dhcal
