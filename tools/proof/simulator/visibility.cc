#include "tools/proof/simulator/visibility.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>

#include "tools/proof/simulator/physics.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStep = 1e-5;                  // [rad] or [m], of the central differences
constexpr double kFamilyWise = 0.01;            // the setting the suite runs at
constexpr double kHypotheses = 200;             // that the known effect competes with
constexpr double kTolerance = 1e-3;             // [rad] or [m], of a freedom
constexpr double kLargestNonCentrality = 2000;  // beyond: found for certain

/// Every freedom of an arm as a function that moves it.
std::vector<std::function<void(Arm*, double)>> Freedoms(const Arm& drawing) {
  std::vector<std::function<void(Arm*, double)>> freedoms;
  for (std::size_t i = 0; i < drawing.links.size(); ++i) {
    freedoms.emplace_back([i](Arm* arm, double x) { arm->links[i].theta += x; });
    freedoms.emplace_back([i](Arm* arm, double x) { arm->links[i].d += x; });
    freedoms.emplace_back([i](Arm* arm, double x) { arm->links[i].a += x; });
    freedoms.emplace_back([i](Arm* arm, double x) { arm->links[i].alpha += x; });
    if (std::abs(std::sin(drawing.links[i].alpha)) < 1e-6 && i + 1 < drawing.links.size()) {
      freedoms.emplace_back([i](Arm* arm, double x) { arm->links[i].beta += x; });
    }
  }
  for (int k = 0; k < 3; ++k) {
    freedoms.emplace_back([k](Arm* arm, double x) {
      arm->base = Displacement(x * Vector3d::Unit(k), Vector3d::Zero()) * arm->base;
    });
    freedoms.emplace_back([k](Arm* arm, double x) { arm->base.translation()[k] += x; });
    freedoms.emplace_back([k](Arm* arm, double x) { arm->tool.translation()[k] += x; });
  }
  return freedoms;
}

double PowerOf(double lambda, int parameters) {
  if (lambda > kLargestNonCentrality) return 1;
  const boost::math::chi_squared central(parameters);
  const double threshold =
      boost::math::quantile(boost::math::complement(central, kFamilyWise / kHypotheses));
  if (lambda < 1e-9) return kFamilyWise / kHypotheses;
  const boost::math::non_central_chi_squared shifted(parameters, lambda);
  return boost::math::cdf(boost::math::complement(shifted, threshold));
}

}  // namespace

VectorXd WithoutKnown(const VectorXd& signal, const MatrixXd& known) {
  Eigen::JacobiSVD<MatrixXd> svd;
  MatrixXd scaled = known;
  for (Index k = 0; k < scaled.cols(); ++k) {
    const double norm = scaled.col(k).norm();
    if (norm > 0) scaled.col(k) /= norm;
  }
  // Rows are many, columns few: the triangular factor has the same directions.
  const Eigen::HouseholderQR<MatrixXd> qr(scaled);
  const MatrixXd R = qr.matrixQR().topRows(scaled.cols()).triangularView<Eigen::Upper>();
  svd.compute(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index rank = (svd.singularValues().array() > 1e-7 * svd.singularValues()[0]).count();
  const MatrixXd basis = scaled * svd.matrixV().leftCols(rank) *
                         svd.singularValues().head(rank).cwiseInverse().asDiagonal();
  VectorXd left = signal - basis * (basis.transpose() * signal);
  left -= basis * (basis.transpose() * left);
  return left;
}

VectorXd Stacked(const MatrixXd& positions) {
  const MatrixXd transposed = positions.transpose();
  return Eigen::Map<const VectorXd>(transposed.data(), transposed.size());
}

MatrixXd GeometrySignatures(const Arm& drawing, const Arm& built, const Motion& motion) {
  const Physics rigid(built.num_joints());
  return GeometrySignatures(
      drawing, built, motion, [&](const Arm& arm) { return TruePositions(arm, rigid, motion); });
}

MatrixXd GeometrySignatures(const Arm& drawing,
                            const Arm& built,
                            const Motion& motion,
                            const std::function<MatrixXd(const Arm&)>& read) {
  const auto freedoms = Freedoms(drawing);
  MatrixXd signatures(3 * motion.num_poses(), static_cast<Index>(freedoms.size()));
  for (std::size_t k = 0; k < freedoms.size(); ++k) {
    Arm more = built, less = built;
    freedoms[k](&more, kStep);
    freedoms[k](&less, -kStep);
    signatures.col(static_cast<Index>(k)) = Stacked(read(more) - read(less)) / (2 * kStep);
  }
  return signatures;
}

MatrixXd Differences(const MatrixXd& rows, const Motion& motion) {
  MatrixXd differences(rows.rows(), rows.cols());
  Index filled = 0;
  for (int k = 1; k < motion.num_poses(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (motion.run[i] != motion.run[i - 1]) continue;
    differences.middleRows(filled, 3) = rows.middleRows(3 * static_cast<Index>(k), 3) -
                                        rows.middleRows(3 * static_cast<Index>(k) - 3, 3);
    filled += 3;
  }
  differences.conservativeResize(filled, Eigen::NoChange);
  return differences;
}

Visibility VisibilityOf(const VectorXd& signal,
                        const MatrixXd& known,
                        double noise,
                        int parameters) {
  Visibility visibility;
  const VectorXd left = WithoutKnown(signal, known);
  const auto rows = static_cast<double>(signal.size());
  visibility.raw_rms = std::sqrt(signal.squaredNorm() / rows);
  visibility.visible_rms = std::sqrt(left.squaredNorm() / rows);
  visibility.lambda = left.squaredNorm() / (noise * noise);
  visibility.power = PowerOf(visibility.lambda, parameters);
  return visibility;
}

Elsewhere ErrorElsewhere(const MatrixXd& geometry_here,
                         const VectorXd& signal_here,
                         const MatrixXd& geometry_there,
                         const VectorXd& signal_there,
                         double noise) {
  // Ridge regression: freedoms in tolerances, rows in noise.
  const MatrixXd A = geometry_here * (kTolerance / noise);
  const MatrixXd normal =
      A.transpose() * A + MatrixXd::Identity(geometry_here.cols(), geometry_here.cols());
  const VectorXd moved = kTolerance * normal.ldlt().solve(A.transpose() * (signal_here / noise));
  const VectorXd error = signal_there - geometry_there * moved;
  Elsewhere elsewhere;
  for (Index k = 0; k + 2 < error.size(); k += 3) {
    const double distance = error.segment<3>(k).norm();
    elsewhere.largest = std::max(elsewhere.largest, distance);
    elsewhere.rms += distance * distance;
  }
  elsewhere.rms = std::sqrt(elsewhere.rms / (static_cast<double>(error.size()) / 3));
  return elsewhere;
}

}  // namespace dhcal::concealed
