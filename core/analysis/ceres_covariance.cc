#include "core/analysis/ceres_covariance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <ceres/covariance.h>
#include <fmt/format.h>

#include "core/analysis/null_space.h"

namespace dhcal {
namespace {

/// One parameter of each dropped direction: those that elimination takes as pivots.
std::vector<bool> Pivots(const TruncatedSvd& svd) {
  std::vector<bool> is_pivot(static_cast<std::size_t>(svd.V.rows()), false);
  const Eigen::MatrixXd basis = SparseBasis(svd.dropped());
  for (Eigen::Index k = 0; k < basis.rows(); ++k) {
    for (Eigen::Index col = 0; col < basis.cols(); ++col) {
      // A pivot's column is a unit vector.
      const auto idx = static_cast<std::size_t>(col);
      const double others = basis.col(col).cwiseAbs().sum() - std::abs(basis(k, col));
      if (std::abs(basis(k, col) - 1.0) < 1e-12 && others < 1e-9 && !is_pivot[idx]) {
        is_pivot[idx] = true;
        break;
      }
    }
  }
  return is_pivot;
}

}  // namespace

CovarianceCheck CheckAgainstCeres(const Identifiability& identifiability,
                                  const std::vector<Parameter>& parameters,
                                  EstimationProblem* problem) {
  CovarianceCheck check;
  check.sigma.assign(parameters.size(), kNotSet);
  const std::vector<bool> held = Pivots(identifiability.all);
  std::vector<std::pair<const double*, const double*>> wanted;
  const std::vector<double*> blocks = problem->blocks();
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (held[k]) {
      problem->problem->SetParameterBlockConstant(blocks[k]);
    } else {
      wanted.emplace_back(blocks[k], blocks[k]);
    }
  }
  // A Ceres built without SuiteSparse still has Eigen's sparse QR.
  const bool suite_sparse = ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE);
  const char* const method = suite_sparse ? "SuiteSparse QR" : "Eigen's sparse QR";
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type =
      suite_sparse ? ceres::SUITE_SPARSE : ceres::EIGEN_SPARSE;
  ceres::Covariance covariance(options);
  const bool computed = covariance.Compute(wanted, problem->problem.get());
  int compared = 0;
  for (std::size_t k = 0; computed && k < blocks.size(); ++k) {
    if (held[k]) continue;
    double variance = kNotSet;
    covariance.GetCovarianceBlock(blocks[k], blocks[k], &variance);
    check.sigma[k] = std::sqrt(variance);
    if (identifiability.parameters[k].verdict != Verdict::kIdentified) continue;
    const auto i = static_cast<Eigen::Index>(k);
    const double ratio = check.sigma[k] / std::sqrt(identifiability.covariance(i, i));
    check.difference = std::fmax(check.difference, std::abs(ratio - 1.0));
    ++compared;
  }
  for (double* const block : blocks) problem->problem->SetParameterBlockVariable(block);

  const auto num_held = std::count(held.begin(), held.end(), true);
  if (!computed) {
    check.sentence =
        fmt::format("{} finds the Jacobian rank deficient; sigmas are the SVD's own.", method);
  } else if (compared == 0) {
    check.sentence =
        fmt::format("No identified parameter to compare between {} and the SVD.", method);
  } else {
    check.sentence = fmt::format(
        "Sigmas of {} identified parameters from {} ({} of {} held) agree with the SVD's to {:.1g} "
        "relative.",
        compared,
        method,
        num_held,
        blocks.size(),
        check.difference);
  }
  return check;
}

}  // namespace dhcal
