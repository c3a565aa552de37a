#include "problems/diagnosis/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Eigenvalues>

#include "core/base/units.h"
#include "core/math/statistics.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStepsPerResolution = 5;  // orders per 2 pi / range of the angle
constexpr Index kOrdersAtOnce = 64;
constexpr double kSmallestShare = 1e-3;  // of a column's square that the basis must leave

/// Sums over the readings that turn a function of one joint's angle (a value per recording row)
/// into products of its column, for any function.
struct JointSums {
  MatrixXd products;        // recording rows x (basis + 1): column' [U, y]
  VectorXd square;          // recording rows: own part of column'column
  VectorXd cross;           // recording rows: part shared with the row before it
  std::vector<int> before;  // recording row before, -1 = none
};

JointSums SumsOf(const DesignRows& rows,
                 const MatrixXd& basis,
                 const VectorXd& y,
                 int slot,
                 int recording_rows) {
  JointSums sums;
  sums.products.setZero(recording_rows, basis.cols() + 1);
  sums.square.setZero(recording_rows);
  sums.cross.setZero(recording_rows);
  sums.before.assign(static_cast<std::size_t>(recording_rows), -1);
  const bool pairs = rows.before().rows() > 0;
  Eigen::RowVectorXd factor(basis.cols() + 1);
  for (int k = 0; k < rows.num_rows(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    factor << basis.row(k), y[k];
    const int now = rows.now_row()[i];
    const double z_now = rows.now()(k, slot);
    sums.products.row(now) += z_now * factor;
    sums.square[now] += z_now * z_now;
    if (!pairs) continue;
    const int before = rows.before_row()[i];
    const double z_before = rows.before()(k, slot);
    sums.products.row(before) -= z_before * factor;
    sums.square[before] += z_before * z_before;
    sums.cross[now] -= 2 * z_now * z_before;
    sums.before[static_cast<std::size_t>(now)] = before;
  }
  return sums;
}

/// a' B b of two functions, B the (tri-diagonal) matrix of the sums.
double Product(const JointSums& sums, const double* a, const double* b) {
  double total = 0;
  for (Index row = 0; row < sums.square.size(); ++row) {
    total += sums.square[row] * a[row] * b[row];
    const int before = sums.before[static_cast<std::size_t>(row)];
    if (before >= 0) {
      total += 0.5 * sums.cross[row] * (a[row] * b[before] + a[before] * b[row]);
    }
  }
  return total;
}

double TailOf(double Q, double rss, double nu, bool sigma_known) {
  if (sigma_known) return ChiSquareTail(Q, 2);
  const double rest = nu - 2;
  return rest < 1 ? 1.0 : FTail(Q / 2 / (std::max(rss - Q, 1e-300) / rest), 2, rest);
}

/// Squares that sine and cosine of one order remove. S: 2 x 2 after projection.
double Removed(const Eigen::Matrix2d& S, const Eigen::Vector2d& z, double norm2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(S);
  double Q = 0;
  for (int k = 0; k < 2; ++k) {
    if (eigen.eigenvalues()[k] <= kSmallestShare * norm2) continue;
    const double part = eigen.eigenvectors().col(k).dot(z);
    Q += part * part / eigen.eigenvalues()[k];
  }
  return Q;
}

SpectralPeak HighestPeak(const PhysicsContext& c, const JointSums& sums, int joint) {
  const VectorXd q = c.q(joint);
  const double range = std::max(q.maxCoeff() - q.minCoeff(), 1e-6);
  const double step = std::min(2 * kPi / range / kStepsPerResolution, 0.5);
  const auto count = static_cast<Index>((kHighestOrder - kLowestOrder) / step) + 1;
  const Index num_rows = q.size(), num_basis = sums.products.cols() - 1;
  // Turning each row's phase by one step costs a product instead of a sine and a cosine.
  Eigen::ArrayXcd phase(num_rows), turn(num_rows);
  for (Index row = 0; row < num_rows; ++row) {
    phase[row] = std::polar(1.0, kLowestOrder * q[row]);
    turn[row] = std::polar(1.0, step * q[row]);
  }
  SpectralPeak peak;
  peak.joint = joint;
  MatrixXd functions(num_rows, 2 * kOrdersAtOnce);
  for (Index first = 0; first < count; first += kOrdersAtOnce) {
    const Index orders = std::min(kOrdersAtOnce, count - first);
    for (Index k = 0; k < orders; ++k) {
      functions.col(2 * k) = phase.imag().matrix();
      functions.col(2 * k + 1) = phase.real().matrix();
      phase *= turn;
    }
    const MatrixXd products = sums.products.transpose() * functions.leftCols(2 * orders);
    for (Index k = 0; k < orders; ++k) {
      const double* const s = functions.col(2 * k).data();
      const double* const o = functions.col(2 * k + 1).data();
      const auto u_s = products.col(2 * k), u_o = products.col(2 * k + 1);
      Eigen::Matrix2d S;
      S(0, 0) = Product(sums, s, s);
      S(1, 1) = Product(sums, o, o);
      S(0, 1) = S(1, 0) = Product(sums, s, o);
      const double norm2 = std::max(S.trace(), 1e-300);
      S(0, 0) -= u_s.head(num_basis).squaredNorm();
      S(1, 1) -= u_o.head(num_basis).squaredNorm();
      S(0, 1) -= u_s.head(num_basis).dot(u_o.head(num_basis));
      S(1, 0) = S(0, 1);
      const double Q = Removed(S, {u_s[num_basis], u_o[num_basis]}, norm2);
      if (Q > peak.Q) {
        peak.Q = Q;
        peak.order = kLowestOrder + static_cast<double>(first + k) * step;
      }
    }
  }
  return peak;
}

bool IsScanned(const PhysicsContext& c, int joint) {
  const VectorXd q = c.q(joint);
  return c.revolute(joint) && q.size() > 0 && q.maxCoeff() - q.minCoeff() > 1e-6;
}

}  // namespace

double ScanWidth(const PhysicsContext& c) {
  double width = 0;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (!IsScanned(c, joint)) continue;
    const VectorXd q = c.q(joint);
    const double variance = (q.array() - q.mean()).square().mean();
    width += (kHighestOrder - kLowestOrder) / (2 * kPi) * std::sqrt(4 * kPi * variance);
  }
  return width;
}

double ScanProbability(double p, double width) {
  const double z = -std::log(std::max(p, 1e-300));
  const double bound = width * p * std::sqrt(std::max(z, 0.0));
  return std::clamp(1 - (1 - p) * std::exp(-bound), 0.0, 1.0);
}

std::vector<SpectralPeak> ScanOrders(const PhysicsContext& c,
                                     const DesignRows& rows,
                                     const MatrixXd& basis,
                                     const VectorXd& y,
                                     double nu,
                                     bool sigma_known) {
  const double rss = y.squaredNorm();
  std::vector<SpectralPeak> peaks;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (!IsScanned(c, joint)) continue;
    const JointSums sums = SumsOf(rows, basis, y, c.joint_slot(joint), c.num_rows());
    peaks.push_back(HighestPeak(c, sums, joint));
  }
  const double width = ScanWidth(c);
  for (SpectralPeak& peak : peaks) {
    peak.p = TailOf(peak.Q, rss, nu, sigma_known);
    peak.p_scan = ScanProbability(peak.p, width);
  }
  return peaks;
}

}  // namespace dhcal
