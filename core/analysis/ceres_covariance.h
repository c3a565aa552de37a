// The parameters' covariance from ceres::Covariance, in the directions that the truncation keeps.
#ifndef DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_
#define DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_

#include <optional>
#include <string>

#include <Eigen/Core>

#include "core/analysis/identifiability.h"
#include "core/model/result.h"
#include "core/solver/estimation_problem.h"

namespace dhcal {

/// Ceres' covariance of all parameters at the problem's state, n x n [rad^2, m^2]: its own in the
/// directions that `svd` keeps (ceres::Manifold), the tolerance along what is dropped. Nothing
/// where Ceres cannot compute it or no direction is kept.
std::optional<Eigen::MatrixXd> CovarianceByCeres(const TruncatedSvd& svd,
                                                 EstimationProblem* problem);

struct CovarianceCheck {
  bool agrees = false;
  double difference = kNotSet;  // largest relative difference of a sigma
  std::string sentence;         // what was compared and the outcome
};

/// Two ways to the same sigmas: QR of the rows by Ceres, and the SVD of their triangle. They differ
/// by rounding, or one of them is wrong.
CovarianceCheck CompareSigmas(const std::optional<Eigen::MatrixXd>& ceres,
                              const Identifiability& identifiability);

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_
