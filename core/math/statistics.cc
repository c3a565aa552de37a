#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace dhcal {
namespace {

/// Beyond this a statistic is as good as infinite; its square is still a number.
constexpr double kLargest = 1e150;

/// A sum of squares, or a ratio of two, as a number that has a score; 0 where it is none.
double Statistic(double x) { return std::isnan(x) ? 0 : std::clamp(x, 0.0, kLargest); }

}  // namespace

double StudentTwoSided(double confidence, double dof) {
  const double upper = 0.5 * (1.0 + confidence);
  if (!std::isfinite(dof)) return boost::math::quantile(boost::math::normal(), upper);
  return boost::math::quantile(boost::math::students_t(dof), upper);
}

double ChiSquareTail(double x, double dof) {
  if (std::isnan(x) || !(dof > 0)) return 1;
  // Boost takes no infinite x.
  const double within = std::clamp(x, 0.0, kLargest);
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(dof), within));
}

double ChiSquareQuantile(double probability, double dof) {
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

double FTail(double x, double k, double nu) {
  if (std::isnan(x) || !(k > 0) || !(nu > 0)) return 1;
  if (std::isinf(nu)) return ChiSquareTail(k * x, k);
  const double within = std::clamp(x, 0.0, kLargest);
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(k, nu), within));
}

double RemovalTail(double Q, double k, double rss, double nu, bool sigma_known) {
  if (sigma_known) return ChiSquareTail(Q, k);
  const double rest = nu - k;
  if (!(k > 0) || rest < 1) return 1;
  return FTail(Q / k / (std::max(rss - Q, 1e-300) / rest), k, rest);
}

double LogChiSquareTail(double x, double dof) {
  const double tail = ChiSquareTail(std::max(x, 0.0), dof);
  if (tail > 1e-290) return std::log(tail);
  // First terms of the asymptotic series of the incomplete gamma function.
  const double a = dof / 2, half = x / 2;
  return (a - 1) * std::log(half) - half - std::lgamma(a) + std::log1p((a - 1) / half);
}

double LogFTail(double x, double k, double nu) {
  const double tail = FTail(std::max(x, 0.0), k, nu);
  if (tail > 1e-290) return std::log(tail);
  // First terms of the incomplete beta function's series at z = nu / (nu + k x).
  const double a = nu / 2, b = k / 2, z = nu / (nu + k * x);
  return a * std::log(z) + b * std::log1p(-z) - std::log(a) + std::lgamma(a + b) - std::lgamma(a) -
         std::lgamma(b) + std::log1p((a + b) / (a + 1) * z);
}

double ChiSquareScore(double mean_square, double dof) {
  const double spread = 2 / (9 * dof);
  return (std::cbrt(Statistic(mean_square)) - (1 - spread)) / std::sqrt(spread);
}

double FScore(double F, double k, double nu) {
  const double a = 2 / (9 * k), b = 2 / (9 * nu), root = std::cbrt(Statistic(F));
  return ((1 - b) * root - (1 - a)) / std::sqrt(b * root * root + a);
}

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double RobustScale(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return 1.4826 * Median(std::move(values));
}

}  // namespace dhcal
