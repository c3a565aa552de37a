#include "residuals/series.h"

#include <cmath>

namespace dhcal {
namespace {

double Weight(double sigma) { return 1.0 / (sigma * sigma); }

}  // namespace

SeriesWhitener::SeriesWhitener(int num_coordinates, int num_cols, double sigma_first)
    : free_offset_(true),
      error_(Eigen::MatrixXd::Zero(num_coordinates, num_cols)),
      mean_(Eigen::MatrixXd::Zero(num_coordinates, num_cols)),
      weight_before_(Weight(sigma_first)) {}

SeriesWhitener::SeriesWhitener(int num_coordinates, int num_cols)
    : free_offset_(false),
      error_(Eigen::MatrixXd::Zero(num_coordinates, num_cols)),
      mean_(Eigen::MatrixXd::Zero(num_coordinates, num_cols)) {}

void SeriesWhitener::Whiten(double sigma, Eigen::Ref<Eigen::MatrixXd> rows) {
  error_ += rows;
  if (!free_offset_) {
    rows = error_ / sigma;
    return;
  }
  const double contrast_sigma = std::sqrt(sigma * sigma + 1.0 / weight_before_);
  rows = (error_ - mean_) / contrast_sigma;
  weight_before_ += Weight(sigma);
  mean_ += Weight(sigma) / weight_before_ * (error_ - mean_);
}

}  // namespace dhcal
