#include "core/analysis/ceres_covariance.h"

#include <cmath>
#include <utility>
#include <vector>

#include <ceres/covariance.h>
#include <fmt/format.h>

#include "core/solver/truncated_subspace.h"

namespace dhcal {
namespace {

// Of double precision's 1e-16, what two factorisations of whitened, tolerance-scaled rows may lose.
constexpr double kAgreement = 1e-9;

ceres::Covariance::Options CovarianceOptions() {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  // A Ceres built without SuiteSparse has Eigen's sparse QR.
  options.sparse_linear_algebra_library_type =
      ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE) ? ceres::SUITE_SPARSE
                                                                            : ceres::EIGEN_SPARSE;
  return options;
}

}  // namespace

std::optional<Eigen::MatrixXd> CovarianceByCeres(const TruncatedSvd& svd,
                                                 EstimationProblem* problem) {
  if (svd.rank == 0) return std::nullopt;
  ceres::Problem* const probe = problem->PreparedProbe();
  const double* const block = problem->probe_block();
  probe->SetManifold(problem->probe_block(), new TruncatedSubspace(svd));
  ceres::Covariance covariance(CovarianceOptions());
  const std::vector<std::pair<const double*, const double*>> wanted = {{block, block}};
  const Eigen::Index n = problem->num_unknowns();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> kept(n, n);
  const bool computed =
      covariance.Compute(wanted, probe) && covariance.GetCovarianceBlock(block, block, kept.data());
  probe->SetManifold(problem->probe_block(), nullptr);
  if (!computed) return std::nullopt;
  const Eigen::MatrixXd hidden = svd.scale.asDiagonal() * svd.dropped();
  return Eigen::MatrixXd(kept) + hidden * hidden.transpose();
}

CovarianceCheck CompareSigmas(const std::optional<Eigen::MatrixXd>& ceres,
                              const Identifiability& identifiability) {
  CovarianceCheck check;
  const Eigen::VectorXd svd = identifiability.covariance.diagonal().cwiseSqrt();
  const auto count = svd.size();
  if (identifiability.all.rank == 0) {
    check.agrees = true;
    check.sentence = "No direction is determined: every sigma is the parameter's tolerance.";
    return check;
  }
  if (!ceres) {
    check.sentence = "ceres::Covariance could not be computed; sigmas are the SVD's, unchecked.";
    return check;
  }
  const Eigen::VectorXd ratio = ceres->diagonal().cwiseSqrt().cwiseQuotient(svd);
  check.difference = (ratio.array() - 1).abs().maxCoeff();
  check.agrees = check.difference <= kAgreement;
  check.sentence = fmt::format(
      check.agrees
          ? "Sigmas of all {} parameters are those of ceres::Covariance in the {} directions "
            "kept; the SVD's agree to {:.1g} relative."
          : "WARNING: sigmas of the {} parameters from ceres::Covariance in the {} directions "
            "kept and from the SVD differ by {:.1g} relative, which is more than rounding: do "
            "not trust the intervals.",
      count,
      identifiability.all.rank,
      check.difference);
  return check;
}

}  // namespace dhcal
