#include "problems/diagnosis/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/math/nonuniform_fourier.h"
#include "core/math/statistics.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStepsPerResolution = 5;  // orders per 2 pi / range of the angle
// Of the squares of a line's two columns that the basis must leave of either phase: of a line of
// which the poses show one phase only, as at the levels of a grid, no reading holds the amplitude.
constexpr double kSmallestShare = 0.02;
// Other orders that remove as much: those of an evenly stepped joint repeat every step.
constexpr std::size_t kMostRivals = 3;
constexpr double kRivalsAtMost = 1e-3;  // chance of a peak below which its rivals matter

/// Sums over the readings that turn a function of one joint's angle (a value per recording row)
/// into products of its column, for any function.
struct JointSums {
  MatrixXd products;        // recording rows x (basis + 1): column' [U, y]
  VectorXd square;          // recording rows: own part of column'column
  VectorXd cross;           // recording rows: part shared with the row before it
  std::vector<int> before;  // recording row before, -1 = none
};

/// Factors by which the columns of now() and before() are multiplied. The rows' own columns are
/// those times W = I - U diag(shrunk) U': a column's squares are less by those of diag(2 shrunk -
/// shrunk^2)^1/2 U' times it, and its products with basis and y are those with W basis and W y.
MatrixXd FactorsOf(const DesignRows& rows, const MatrixXd& basis, const VectorXd& y) {
  const Eigen::ArrayXd shrunk = rows.shrunk().array();
  MatrixXd factors(y.size(), shrunk.size() + basis.cols() + 1);
  factors << rows.shared() * (2 * shrunk - shrunk.square()).sqrt().matrix().asDiagonal(),
      rows.Shrunk(basis), rows.Shrunk(y);
  if (const SlowNoiseFilter* const slow = rows.slow_filter()) {
    for (Index k = 0; k < factors.cols(); ++k) slow->WhitenAdjoint(factors.col(k));
  }
  return factors;
}

void AddSquares(const DesignRows& rows, int slot, JointSums* sums) {
  const bool pairs = rows.before().rows() > 0;
  for (int k = 0; k < rows.num_rows(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const int now = rows.now_row()[i];
    const double z_now = rows.now()(k, slot);
    sums->square[now] += z_now * z_now;
    if (!pairs) continue;
    const int before = rows.before_row()[i];
    const double z_before = rows.before()(k, slot);
    sums->square[before] += z_before * z_before;
    sums->cross[now] -= 2 * z_now * z_before;
    sums->before[static_cast<std::size_t>(now)] = before;
  }
}

/// Behind the slow filter, of whose precision lags above one are left out: angles that a high order
/// takes from reading to reading are far apart.
void AddSlowSquares(const DesignRows& rows, int slot, JointSums* sums) {
  const SlowNoiseFilter::Precision precision = rows.slow_filter()->PrecisionOf();
  const int m = rows.coordinates();
  for (int k = 0; k < rows.num_rows(); ++k) {
    const int now = rows.recording_row(k / m);
    const double z_now = rows.now()(k, slot);
    sums->square[now] += precision.own[k / m] * z_now * z_now;
    if (k < m || precision.with_before[k / m] == 0) continue;
    const double z_before = rows.now()(k - m, slot);
    sums->cross[now] += 2 * precision.with_before[k / m] * z_now * z_before;
    sums->before[static_cast<std::size_t>(now)] = rows.recording_row(k / m - 1);
  }
}

/// `factors`: y's last.
JointSums SumsOf(const DesignRows& rows, const MatrixXd& factors, int slot, int recording_rows) {
  JointSums sums;
  sums.products.setZero(recording_rows, factors.cols());
  sums.square.setZero(recording_rows);
  sums.cross.setZero(recording_rows);
  sums.before.assign(static_cast<std::size_t>(recording_rows), -1);
  const bool pairs = rows.before().rows() > 0;
  if (rows.slow_filter() != nullptr) {
    AddSlowSquares(rows, slot, &sums);
  } else {
    AddSquares(rows, slot, &sums);
  }
  for (Index column = 0; column < factors.cols(); ++column) {
    const double* const factor = factors.col(column).data();
    double* const product = sums.products.col(column).data();
    for (int k = 0; k < rows.num_rows(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      product[rows.now_row()[i]] += rows.now()(k, slot) * factor[k];
      if (pairs) product[rows.before_row()[i]] -= rows.before()(k, slot) * factor[k];
    }
  }
  return sums;
}

/// The orders k step, k = first ... first + count - 1, of one joint.
struct OrderGrid {
  double step = 0;
  int first = 0, count = 0;
  double order(int k) const { return (first + k) * step; }
};

OrderGrid GridOf(const VectorXd& q) {
  OrderGrid grid;
  const double range = std::max(q.maxCoeff() - q.minCoeff(), 1e-6);
  grid.step = std::min(2 * kPi / range / kStepsPerResolution, 0.5);
  grid.first = static_cast<int>(std::ceil(kLowestOrder / grid.step));
  grid.count = std::max(1, static_cast<int>(kHighestOrder / grid.step) - grid.first + 1);
  return grid;
}

/// Products of the sine's and the cosine's columns of every order, by the addition theorems: with
/// w the order, B the (tri-diagonal) matrix of the sums,
///   2 s'Bs = D - C, 2 o'Bo = D + C, 2 s'Bo = N,  C + i N = sum b_ij exp(i w (q_i + q_j)),
///   D = sum b_ij cos w (q_i - q_j).
struct OrderProducts {
  Eigen::ArrayXd ss, oo, so;
};

OrderProducts ProductsOf(const JointSums& sums, const VectorXd& q, const OrderGrid& grid) {
  std::vector<double> plus, weight, minus, cross;
  for (Index row = 0; row < q.size(); ++row) {
    if (sums.square[row] > 0) {
      plus.push_back(2 * q[row]);
      weight.push_back(sums.square[row]);
    }
    const int before = sums.before[static_cast<std::size_t>(row)];
    if (before < 0) continue;
    plus.push_back(q[row] + q[before]);
    weight.push_back(sums.cross[row]);
    minus.push_back(q[row] - q[before]);
    cross.push_back(sums.cross[row]);
  }
  const auto as_vector = [](const std::vector<double>& values) {
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
  };
  const int size = grid.first + grid.count;
  const Eigen::ArrayXcd C =
      NonuniformFourier(grid.step * as_vector(plus), size).Sums(as_vector(weight)).tail(grid.count);
  Eigen::ArrayXd D = Eigen::ArrayXd::Constant(grid.count, sums.square.sum());
  if (!minus.empty()) {
    D += NonuniformFourier(grid.step * as_vector(minus), size)
             .Sums(as_vector(cross))
             .tail(grid.count)
             .real();
  }
  return {(D - C.real()) / 2, (D + C.real()) / 2, C.imag() / 2};
}

/// Squares that sine and cosine of one order remove, 0 where a phase is not seen. S: 2 x 2 after
/// projection.
double Removed(const Eigen::Matrix2d& S, const Eigen::Vector2d& z, double norm2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(S);
  if (eigen.eigenvalues()[0] <= kSmallestShare * norm2) return 0;
  return (eigen.eigenvectors().transpose() * z)
      .cwiseAbs2()
      .cwiseQuotient(eigen.eigenvalues())
      .sum();
}

/// The order between grid points at which a parabola through three has its top.
double TopBetween(const OrderGrid& grid, const Eigen::ArrayXd& Q, int k) {
  if (k == 0 || k + 1 == grid.count) return grid.order(k);
  const double bend = Q[k - 1] - 2 * Q[k] + Q[k + 1];
  const double shift = bend < 0 ? 0.5 * (Q[k - 1] - Q[k + 1]) / bend : 0.0;
  return grid.order(k) + std::clamp(shift, -0.5, 0.5) * grid.step;
}

/// The highest of the orders' Q, and the peaks apart from it and each other that come within
/// `margin` of it; at most so many.
std::vector<int> HighestAndRivals(const Eigen::ArrayXd& Q, double margin, std::size_t most) {
  const double least = Q.maxCoeff() - margin;
  std::vector<int> peaks;
  for (Index k = 0; k < Q.size(); ++k) {
    const bool top = (k == 0 || Q[k] > Q[k - 1]) && (k + 1 == Q.size() || Q[k] >= Q[k + 1]);
    if (top && Q[k] >= least) peaks.push_back(static_cast<int>(k));
  }
  std::stable_sort(peaks.begin(), peaks.end(), [&](int a, int b) { return Q[a] > Q[b]; });
  std::vector<int> apart;
  for (const int peak : peaks) {
    const bool near = std::any_of(apart.begin(), apart.end(), [&](int other) {
      return std::abs(peak - other) <= kStepsPerResolution;
    });
    if (!near) apart.push_back(peak);
    if (apart.size() == most) break;
  }
  return apart;
}

/// Those of one joint, the highest first.
std::vector<SpectralPeak> HighestPeaks(
    const PhysicsContext& c, const JointSums& sums, int joint, double margin, std::size_t most) {
  const VectorXd q = c.q(joint);
  const OrderGrid grid = GridOf(q);
  OrderProducts S = ProductsOf(sums, q, grid);
  const Eigen::ArrayXd norm2 = (S.ss + S.oo).max(1e-300);
  const NonuniformFourier fourier(grid.step * q, grid.first + grid.count);
  const Index num_basis = sums.products.cols() - 1;
  for (Index k = 0; k < num_basis; ++k) {
    const Eigen::ArrayXcd u = fourier.Sums(sums.products.col(k)).tail(grid.count);
    S.ss -= u.imag().square();
    S.oo -= u.real().square();
    S.so -= u.imag() * u.real();
  }
  const Eigen::ArrayXcd z = fourier.Sums(sums.products.col(num_basis)).tail(grid.count);
  Eigen::ArrayXd Q(grid.count);
  for (int k = 0; k < grid.count; ++k) {
    Eigen::Matrix2d S_k;
    S_k << S.ss[k], S.so[k], S.so[k], S.oo[k];
    Q[k] = Removed(S_k, {z[k].imag(), z[k].real()}, norm2[k]);
  }
  std::vector<SpectralPeak> peaks;
  for (const int k : HighestAndRivals(Q, margin, most)) {
    SpectralPeak peak;
    peak.joint = joint;
    peak.Q = Q[k];
    peak.order = TopBetween(grid, Q, k);
    peaks.push_back(peak);
  }
  return peaks;
}

bool IsScanned(const PhysicsContext& c, int joint) { return c.revolute(joint) && c.moves(joint); }

}  // namespace

bool IsScannedLine(const EffectRequest& request) {
  return request.effect == kLineEffect && request.setting("order", 0) >= kLowestOrder;
}

bool StopsAtFewPlaces(const VectorXd& q) {
  constexpr double kSamePlace = 1e-5;  // [rad]
  constexpr double kTimesAtEach = 3;
  std::vector<double> sorted(q.begin(), q.end());
  std::sort(sorted.begin(), sorted.end());
  double places = sorted.empty() ? 0 : 1;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k] - sorted[k - 1] > kSamePlace) ++places;
  }
  return static_cast<double>(sorted.size()) >= kTimesAtEach * places;
}

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
                                     const ScannedRows& scanned) {
  const double rss = scanned.y.squaredNorm();
  std::vector<int> joints;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (IsScanned(c, joint)) joints.push_back(joint);
  }
  const double variance = scanned.sigma_known ? 1 : rss / std::max(scanned.nu, 1.0);
  const double margin = kTuning.list_margin * variance;
  const std::size_t most = scanned.with_rivals ? 1 + kMostRivals : 1;
  const MatrixXd factors = FactorsOf(rows, scanned.basis, scanned.y);
  std::vector<std::vector<SpectralPeak>> of_joint(joints.size());
  ParallelFor(static_cast<int>(joints.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const JointSums sums = SumsOf(rows, factors, c.joint_slot(joints[i]), c.num_rows());
    of_joint[i] = HighestPeaks(c, sums, joints[i], margin, most);
  });
  const double width = ScanWidth(c);
  std::vector<SpectralPeak> peaks;
  for (const std::vector<SpectralPeak>& own : of_joint) {
    for (SpectralPeak peak : own) {
      // Sine and cosine.
      peak.p = RemovalTail(peak.Q, 2, rss, scanned.nu, scanned.sigma_known);
      peak.p_scan = ScanProbability(peak.p, width);
      const bool rival = !peaks.empty() && peaks.back().joint == peak.joint;
      if (!rival || peak.p_scan < kRivalsAtMost) peaks.push_back(peak);
    }
  }
  return peaks;
}

}  // namespace dhcal
