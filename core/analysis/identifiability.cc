#include "core/analysis/identifiability.h"

#include <cmath>
#include <limits>

#include "core/solver/truncation.h"

namespace dhcal {
namespace {

constexpr double kConfounded = 1.0 / 7.0;      // [tolerances]
constexpr double kAllHidden = 0.999;           // [tolerances]
constexpr double kWellDetermined = 1.0 / 3.0;  // [tolerances]
constexpr double kHarmlessBias = 0.2;          // [sigmas]: 95 % intervals still cover 94.5 %

/// D (V_k s^-2 V_k' + V_d V_d') D: kept directions from the data, dropped ones from the tolerance.
Eigen::MatrixXd CovarianceOf(const TruncatedSvd& svd) {
  const Eigen::MatrixXd kept = svd.kept() * svd.s.head(svd.rank).cwiseInverse().asDiagonal();
  const Eigen::MatrixXd unscaled =
      kept * kept.transpose() + svd.dropped() * svd.dropped().transpose();
  return svd.scale.asDiagonal() * unscaled * svd.scale.asDiagonal();
}

/// Sun, Hollerbach, "Observability index selection for robot calibration", ICRA 2008, eqs. 6-10.
ObservabilityIndices Indices(const TruncatedSvd& svd, int num_poses) {
  ObservabilityIndices indices;
  if (svd.rank == 0) return indices;
  const auto s = svd.s.head(svd.rank).array();
  const double largest = s[0], smallest = s[svd.rank - 1];
  indices.o1 = std::exp(s.log().mean()) / std::sqrt(num_poses);
  indices.o2 = smallest / largest;
  indices.o3 = smallest;
  indices.o4 = smallest * smallest / largest;
  indices.o5 = 1.0 / s.inverse().sum();
  return indices;
}

}  // namespace

Verdict VerdictOf(const Determination& d) {
  if (!(d.alone < 1.0) || d.hidden > kAllHidden) return Verdict::kUnobservable;
  if (d.hidden > kConfounded) return Verdict::kConfounded;
  const bool sharp = std::hypot(d.sigma, d.hidden) < kWellDetermined;
  if (sharp && d.hidden <= kHarmlessBias * d.sigma) return Verdict::kIdentified;
  return Verdict::kWeak;
}

Identifiability Identify(const Linearization& readings,
                         const Linearization& all,
                         const Eigen::VectorXd& tolerance,
                         int num_poses) {
  const Truncation noise_rule;
  Identifiability result;
  result.readings = Truncate(noise_rule, tolerance, readings);
  result.all = Truncate(noise_rule, tolerance, all);
  result.covariance = CovarianceOf(result.all);
  result.observability = Indices(result.readings, num_poses);
  const TruncatedSvd& svd = result.readings;
  if (svd.rank > 0) result.condition_number = svd.s[0] / svd.s[svd.rank - 1];

  const double rounding =
      static_cast<double>(svd.s.size()) * std::numeric_limits<double>::epsilon() * svd.s[0];
  result.numerical_rank = static_cast<int>((svd.s.array() > rounding).count());

  const Eigen::VectorXd inverse_s = svd.s.head(svd.rank).cwiseInverse();
  for (Eigen::Index k = 0; k < tolerance.size(); ++k) {
    Determination d;
    d.alone = 1.0 / (readings.R.col(k).norm() * tolerance[k]);
    d.sigma = svd.kept().row(k).transpose().cwiseProduct(inverse_s).norm();
    d.hidden = svd.dropped().row(k).norm();
    d.verdict = VerdictOf(d);
    result.parameters.push_back(d);
  }
  return result;
}

}  // namespace dhcal
