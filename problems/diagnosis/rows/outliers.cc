#include "problems/diagnosis/rows/outliers.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include "core/math/statistics.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMostLeverage = 0.9;

std::vector<double> SquaredLengths(const VectorXd& residuals,
                                   const VectorXd& leverage,
                                   int coordinates) {
  std::vector<double> squares;
  for (Index k = 0; k < residuals.size() / coordinates; ++k) {
    const double taken = leverage.size() > 0 ? std::min(leverage[k], kMostLeverage) : 0.0;
    squares.push_back(residuals.segment(k * coordinates, coordinates).squaredNorm() / (1 - taken));
  }
  return squares;
}

double MedianOfUnit(int coordinates) {
  return boost::math::quantile(boost::math::chi_squared(coordinates), 0.5);
}

}  // namespace

int Outliers::count() const {
  return static_cast<int>(std::count(fitted.begin(), fitted.end(), true) +
                          std::count(test.begin(), test.end(), true));
}

double BoundedSquare(double square) {
  const double bound = kTuning.predictive_bound;
  return square < bound ? square : bound * (1 + std::log(square / bound));
}

double RobustVariance(const VectorXd& residuals, int coordinates) {
  if (residuals.size() == 0) return 1;
  return Median(SquaredLengths(residuals, {}, coordinates)) / MedianOfUnit(coordinates);
}

Outliers FindOutliers(const ReadingResiduals& residuals, bool sigma_known) {
  const int m = residuals.coordinates;
  const std::vector<double> fitted = SquaredLengths(residuals.fitted, residuals.leverage, m);
  const std::vector<double> test = SquaredLengths(residuals.test, {}, m);
  Outliers outliers;
  outliers.fitted.assign(fitted.size(), false);
  outliers.test.assign(test.size(), false);
  if (fitted.empty()) return outliers;
  double variance = Median(fitted) / MedianOfUnit(m);
  if (sigma_known) variance = std::max(variance, 1.0);
  outliers.scale = std::sqrt(variance);
  const double tail =
      2 * boost::math::cdf(boost::math::complement(boost::math::normal(), kTuning.outlier_sigmas));
  double limit =
      variance * boost::math::quantile(boost::math::complement(boost::math::chi_squared(m), tail));
  std::vector<double> all = fitted;
  all.insert(all.end(), test.begin(), test.end());
  const auto most = static_cast<std::size_t>(
      std::ceil((1 - kTuning.most_outliers) * static_cast<double>(all.size())));
  std::sort(all.begin(), all.end());
  if (most < all.size()) limit = std::max(limit, all[most]);
  for (std::size_t k = 0; k < fitted.size(); ++k) outliers.fitted[k] = fitted[k] > limit;
  for (std::size_t k = 0; k < test.size(); ++k) outliers.test[k] = test[k] > limit;
  return outliers;
}

}  // namespace dhcal
