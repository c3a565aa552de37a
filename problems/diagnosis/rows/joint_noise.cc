#include "problems/diagnosis/rows/joint_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace dhcal {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSharesTried = 60;
// Variance by the joints over the rest, on average; the rest over all residuals' variance.
constexpr double kLeastShare = 1e-2, kMostShare = 1e4;
constexpr double kLeastRest = 1e-4, kMostRest = 2;

/// Along the principal axes of each reading's J J': squares of y, and the eigenvalues.
struct PrincipalRows {
  ArrayXd squares, by_joints;
};

PrincipalRows AlongAxes(const VectorXd& y, const MatrixXd& J, int coordinates) {
  PrincipalRows rows{ArrayXd(y.size()), ArrayXd(y.size())};
  for (Index first = 0; first < y.size(); first += coordinates) {
    const auto own = J.middleRows(first, coordinates);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(own * own.transpose());
    rows.squares.segment(first, coordinates) =
        (eigen.eigenvectors().transpose() * y.segment(first, coordinates)).array().square();
    rows.by_joints.segment(first, coordinates) = eigen.eigenvalues().cwiseMax(0);
  }
  return rows;
}

}  // namespace

LikeliestJointNoise FindJointNoise(const VectorXd& y, const MatrixXd& J, int coordinates) {
  LikeliestJointNoise likeliest;
  if (y.size() == 0 || J.cols() == 0) return likeliest;
  const PrincipalRows rows = AlongAxes(y, J, coordinates);
  const double mean = rows.by_joints.mean();
  if (!(mean > 0)) return likeliest;
  const auto n = static_cast<double>(y.size());
  const double without = n * std::log(rows.squares.mean());
  for (int k = 0; k < kSharesTried; ++k) {
    const double share =
        kLeastShare * std::pow(kMostShare / kLeastShare, static_cast<double>(k) / kSharesTried);
    const ArrayXd variance = 1 + share / mean * rows.by_joints;
    const double phi = (rows.squares / variance).mean();
    const double evidence = without - n * std::log(phi) - variance.log().sum();
    if (evidence <= likeliest.evidence) continue;
    likeliest.evidence = evidence;
    likeliest.rest = phi;
    likeliest.sigma = std::sqrt(phi * share / mean);
  }
  return likeliest;
}

double EvidenceOfCovariance(const VectorXd& y, const MatrixXd& J, int coordinates) {
  if (y.size() == 0) return 0;
  const PrincipalRows rows = AlongAxes(y, J, coordinates);
  const double mean = rows.squares.mean();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSharesTried; ++k) {
    const double phi =
        mean * kLeastRest * std::pow(kMostRest / kLeastRest, static_cast<double>(k) / kSharesTried);
    const ArrayXd variance = phi + rows.by_joints;
    least = std::min(least, (variance.log() + rows.squares / variance).sum());
  }
  return static_cast<double>(y.size()) * (std::log(mean) + 1) - least;
}

}  // namespace dhcal
