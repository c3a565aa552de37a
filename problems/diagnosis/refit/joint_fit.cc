#include "problems/diagnosis/refit/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/QR>

#include "core/math/products.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSteps[] = {1.0, 0.5, 0.2, 0.05};
constexpr double kSettled = 0.5;  // squares
// Of a scaled unknown's own squares: rounding must not make them negative.
constexpr double kSmall = 1e-13;

JointState Moved(const JointRows& joint, const VectorXd& step, double part) {
  JointState moved = joint.state;
  Index at = 0;
  for (const int k : joint.free) moved.geometry[k] += part * step[at++];
  for (Member& member : moved.members) {
    member.value += part * step.segment(at, member.item.size);
    at += member.item.size;
  }
  for (const int k : joint.mass_idx) moved.masses[k] += part * step[at++];
  return moved;
}

}  // namespace

double SquaresLeft(const JointModel& model, const JointRows& joint, double phi) {
  double priors = joint.value.cwiseProduct(joint.precision).squaredNorm();
  for (const int k : joint.free) {
    const double in_priors = joint.state.geometry[k] / model.prior()[k];
    priors += in_priors * in_priors;
  }
  for (const int k : joint.mass_idx) priors += joint.state.masses[k] * joint.state.masses[k];
  return joint.y().squaredNorm() + phi * priors;
}

Augmented AugmentedRows(const JointModel& model, const JointRows& joint, const MatrixXd& N) {
  Augmented augmented;
  const Index rows = joint.y().size();
  const auto free = static_cast<Index>(joint.free.size());
  const Index members = joint.X.cols(), masses = N.cols();
  const double root = std::sqrt(joint.phi);
  augmented.num_free = static_cast<int>(free);
  augmented.num_members = static_cast<int>(members);
  augmented.num_masses = static_cast<int>(masses);
  augmented.B = MatrixXd::Zero(rows + free + members + masses, free + members + masses);
  augmented.B.topRows(rows) << joint.FreeColumns(), joint.X, N;
  augmented.y = VectorXd::Zero(rows + free + members + masses);
  augmented.y.head(rows) = joint.y();
  for (Index k = 0; k < free; ++k) {
    const int unknown = joint.free[static_cast<std::size_t>(k)];
    const double precision = root / model.prior()[unknown];
    augmented.B(rows + k, k) = precision;
    augmented.y[rows + k] = -precision * joint.state.geometry[unknown];
  }
  for (Index k = 0; k < members; ++k) {
    const double precision = root * joint.precision[k];
    augmented.B(rows + free + k, free + k) = precision;
    augmented.y[rows + free + k] = -precision * joint.value[k];
  }
  for (Index k = 0; k < masses; ++k) {
    augmented.B(rows + free + members + k, free + members + k) = root;
    augmented.y[rows + free + members + k] =
        -root * joint.state.masses[joint.mass_idx[static_cast<std::size_t>(k)]];
  }
  return augmented;
}

JointRows FitJointly(const JointModel& model,
                     const JointState& start,
                     const RowChoice& choice,
                     const std::vector<int>& free,
                     int iterations) {
  JointRows joint = model.At(start, choice, free);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Augmented augmented = AugmentedRows(model, joint, joint.N);
    const NormalFactor normal(augmented.B);
    const VectorXd step = normal.Solve(augmented.B.transpose() * augmented.y);
    const double phi = joint.phi, before = SquaresLeft(model, joint, phi);
    bool moved = false;
    for (const double part : kSteps) {
      JointRows tried = model.At(Moved(joint, step, part), choice, free);
      if (!(SquaresLeft(model, tried, phi) < before)) continue;
      joint = std::move(tried);
      moved = true;
      break;
    }
    if (!moved) break;
    if (iteration > 0 && before - SquaresLeft(model, joint, phi) < kSettled) break;
  }
  return joint;
}

namespace {

/// Columns of the elastic members in X.
std::vector<int> ElasticColumns(const JointRows& joint) {
  std::vector<int> elastic;
  for (std::size_t m = 0; m < joint.state.members.size(); ++m) {
    if (!joint.state.members[m].item.elastic) continue;
    const int first = joint.FirstColumn(m);
    for (int i = 0; i < joint.state.members[m].item.size; ++i) elastic.push_back(first + i);
  }
  return elastic;
}

/// How much of the elastic columns is in each column of N, beside the geometry under its prior.
MatrixXd ShareOfMasses(const JointModel& model,
                       const JointRows& joint,
                       const std::vector<int>& elastic) {
  JointRows geometry_only = joint;
  geometry_only.X.resize(joint.X.rows(), 0);
  geometry_only.value.resize(0);
  geometry_only.precision.resize(0);
  const Augmented augmented = AugmentedRows(model, geometry_only, MatrixXd(joint.y().size(), 0));
  const MatrixXd Q = ThinBasis(augmented.B);
  const auto Q_rows = Q.topRows(joint.y().size());
  const MatrixXd X = joint.X(Eigen::all, elastic);
  const MatrixXd P = Deducted(X, Q_rows, TransposedProduct(Q_rows, X));
  const MatrixXd R = Deducted(joint.N, Q_rows, TransposedProduct(Q_rows, joint.N));
  const VectorXd lengths = ColumnLengths(P);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(P * lengths.cwiseInverse().asDiagonal());
  qr.setThreshold(1e-8);
  return lengths.cwiseInverse().asDiagonal() * qr.solve(R);
}

}  // namespace

MatrixXd TiedMasses(const JointModel& model, const JointRows& joint) {
  if (joint.N.cols() == 0) return joint.N;
  const std::vector<int> elastic = ElasticColumns(joint);
  return joint.N - joint.X(Eigen::all, elastic) * ShareOfMasses(model, joint, elastic);
}

VectorXd TiedValues(const JointModel& model, const JointRows& joint) {
  VectorXd value = joint.value;
  if (joint.N.cols() == 0) return value;
  const std::vector<int> elastic = ElasticColumns(joint);
  const VectorXd masses = joint.state.masses(joint.mass_idx);
  value(elastic) += ShareOfMasses(model, joint, elastic) * masses;
  return value;
}

MatrixXd JointCovariance(const JointModel& model, const JointRows& joint) {
  const Augmented augmented = AugmentedRows(model, joint, TiedMasses(model, joint));
  const NormalFactor normal(augmented.B);
  const Index kept = augmented.num_free + augmented.num_members;
  return normal.Inverse().topLeftCorner(kept, kept);
}

NormalFactor::NormalFactor(const MatrixXd& B) : scale_(ColumnLengths(B).cwiseInverse()) {
  MatrixXd H = scale_.asDiagonal() * SquareOf(B) * scale_.asDiagonal();
  H.diagonal().array() += kSmall;
  factor_.compute(H);
}

VectorXd NormalFactor::Solve(const VectorXd& b) const {
  return scale_.cwiseProduct(VectorXd(factor_.solve(scale_.cwiseProduct(b))));
}

MatrixXd NormalFactor::Inverse() const {
  const Index size = scale_.size();
  const MatrixXd root = factor_.matrixL().solve(MatrixXd::Identity(size, size));
  return scale_.asDiagonal() * (root.transpose() * root) * scale_.asDiagonal();
}

MatrixXd NormalFactor::Whiten(const MatrixXd& rows) const {
  return TallProduct(rows, scale_.asDiagonal() * InverseRoot(factor_));
}

}  // namespace dhcal
