#include "residuals/running_means.h"

#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace dhcal {
namespace {

double Weight(double sigma) { return 1.0 / (sigma * sigma); }

}  // namespace

RunningMeans::RunningMeans(std::vector<int> previous, Eigen::VectorXd sigma)
    : previous_(std::move(previous)), sigma_(std::move(sigma)) {
  CHECK_EQ(static_cast<Eigen::Index>(previous_.size()), sigma_.size());
  weight_before_.setZero(sigma_.size());
  for (int row_idx = 0; row_idx < num_rows(); ++row_idx) {
    const int before = previous_[static_cast<std::size_t>(row_idx)];
    CHECK_LT(before, row_idx);
    if (before >= 0) weight_before_[row_idx] = weight_before_[before] + Weight(sigma_[before]);
  }
}

double RunningMeans::contrast_sigma(int row_idx) const {
  CHECK_GE(previous_[static_cast<std::size_t>(row_idx)], 0);
  return std::sqrt(sigma_[row_idx] * sigma_[row_idx] + 1.0 / weight_before_[row_idx]);
}

Eigen::Matrix3Xd RunningMeans::Means(const Eigen::Matrix3Xd& values, Eigen::Index stride) const {
  Eigen::Matrix3Xd means = Eigen::Matrix3Xd::Zero(3, values.cols());
  for (int row_idx = 0; row_idx < num_rows(); ++row_idx) {
    const int before = previous_[static_cast<std::size_t>(row_idx)];
    if (before < 0) continue;
    const double share = Weight(sigma_[before]) / weight_before_[row_idx];
    const auto earlier = means.middleCols(before * stride, stride);
    means.middleCols(row_idx * stride, stride) =
        earlier + share * (values.middleCols(before * stride, stride) - earlier);
  }
  return means;
}

}  // namespace dhcal
