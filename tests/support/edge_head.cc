#include "tests/support/edge_head.h"

#include <complex>
#include <utility>
#include <vector>

#include "core/base/rng.h"
#include "tests/support/robots.h"

namespace dhcal::independent {
namespace {

using Complex = std::complex<double>;
constexpr double kComplexStep = 1e-30;

Eigen::Vector3d NormalOf(double sigma, Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

/// Joint whose beta completes the KR 15: axes 2 and 3 are parallel.
constexpr int kBetaSlot = 5 * 1 + 4;

Matrix4<Complex> PoseInBase(const ProblemSpec& spec,
                            const Eigen::VectorXd& q,
                            const Vector<Complex>& delta) {
  return ForwardKinematics<Complex>(
      spec.robot, q, delta, Eigen::Isometry3d::Identity(), spec.robot.X_TQ);
}

/// d numbers / d column of one row, 3 x columns.
Eigen::MatrixXd RowJacobian(const ProblemSpec& spec,
                            const HeadTruth& truth,
                            const Recording& rows,
                            int row_idx) {
  const Eigen::Index n = spec.robot.num_joints(), robot_slots = 5 * n;
  const Eigen::VectorXd q = rows.q.row(row_idx).transpose();
  const Eigen::Isometry3d& X_BE = truth.edges.at(rows.edge_names[rows.edge(row_idx)]);
  std::vector<std::pair<Eigen::Index, double>> slots;  // and what one column unit is
  for (Eigen::Index k = 0; k < robot_slots; ++k) {
    const Eigen::Index number = k % 5;
    if (number == 4 && k != kBetaSlot) continue;
    slots.emplace_back(k, number == 0 ? 3e-3 : number == 1 || number == 2 ? 5e-4 : 1e-3);
  }
  for (Eigen::Index k = 0; k < 6; ++k) slots.emplace_back(robot_slots + 6 + k, 5e-3);
  const auto edges = static_cast<Eigen::Index>(rows.edge_names.size());
  const auto of_robot = static_cast<Eigen::Index>(slots.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, of_robot + 6 * edges);
  const Matrix4<Complex> edge = X_BE.matrix().cast<Complex>();
  for (Eigen::Index c = 0; c < of_robot; ++c) {
    Vector<Complex> delta = truth.delta.cast<Complex>();
    delta[slots[c].first] += Complex(0, kComplexStep);
    J.col(c) =
        HeadNumbers<Complex>(spec.measurement.head, PoseInBase(spec, q, delta), edge).imag() *
        slots[c].second / kComplexStep;
  }
  const Matrix4<Complex> X_BQ = PoseInBase(spec, q, truth.delta.cast<Complex>());
  for (Eigen::Index k = 0; k < 6; ++k) {
    Vector<Complex> own = Vector<Complex>::Zero(6);
    own[k] = Complex(0, kComplexStep);
    const Matrix4<Complex> moved = edge * Moved<Complex>(Eigen::Isometry3d::Identity(), own, 0);
    J.col(of_robot + 6 * rows.edge(row_idx) + k) =
        HeadNumbers<Complex>(spec.measurement.head, X_BQ, moved).imag() * 5e-3 / kComplexStep;
  }
  return J;
}

}  // namespace

HeadTruth MakeHeadTruth(const ProblemSpec& spec, std::uint64_t seed) {
  Rng rng(seed);
  HeadTruth truth;
  const int n = spec.robot.num_joints();
  truth.delta = Eigen::VectorXd::Zero(5 * n + 12);
  const std::vector<double> sizes = {1e-3, 3e-4, 3e-4, 5e-4, 0};  // theta, d, a, alpha, beta
  for (int k = 0; k < 5 * n; ++k) truth.delta[k] = sizes[k % 5] * rng.Normal();
  truth.delta[kBetaSlot] = 5e-4 * rng.Normal();
  truth.delta.segment<3>(5 * n + 6) = NormalOf(2e-3, &rng);
  truth.delta.tail<3>() = NormalOf(5e-3, &rng);
  for (const Edge& edge : spec.robot.edges) {
    const Eigen::Isometry3d moved = MakeFrame(NormalOf(1e-2, &rng), NormalOf(2e-2, &rng));
    truth.edges[edge.name] = *edge.X_WE * moved;
  }
  return truth;
}

Matrix4<double> PoseOfRow(const ProblemSpec& spec,
                          const HeadTruth& truth,
                          const Recording& rows,
                          int row_idx) {
  return ForwardKinematics<double>(spec.robot,
                                   rows.q.row(row_idx).transpose(),
                                   truth.delta,
                                   Eigen::Isometry3d::Identity(),
                                   spec.robot.X_TQ);
}

Eigen::Vector3d NumbersOfRow(const ProblemSpec& spec,
                             const HeadTruth& truth,
                             const Recording& rows,
                             int row_idx) {
  const Matrix4<double> X_BQ = PoseOfRow(spec, truth, rows, row_idx);
  const Matrix4<double> X_BE = truth.edges.at(rows.edge_names[rows.edge(row_idx)]).matrix();
  return HeadNumbers<double>(spec.measurement.head, X_BQ, X_BE);
}

Recording RecordNumbers(const ProblemSpec& spec,
                        const Recording& rows,
                        double noise,
                        std::uint64_t seed,
                        const std::function<Eigen::Vector3d(int row_idx)>& numbers) {
  Rng rng(seed);
  Recording recording = rows;
  recording.head.resize(rows.num_rows(), 3);
  for (int row = 0; row < rows.num_rows(); ++row) {
    Eigen::Vector3d error = NormalOf(noise, &rng);
    for (int c = 0; c < 3; ++c) {
      error[c] *= spec.measurement.kind.coordinates[static_cast<std::size_t>(c)].noise;
    }
    recording.head.row(row) = numbers(row) + error;
  }
  return recording;
}

Recording RecordHead(const ProblemSpec& spec,
                     const HeadTruth& truth,
                     const Recording& rows,
                     double noise,
                     std::uint64_t seed) {
  return RecordNumbers(
      spec, rows, noise, seed, [&](int row) { return NumbersOfRow(spec, truth, rows, row); });
}

Eigen::MatrixXd HeadJacobian(const ProblemSpec& spec,
                             const HeadTruth& truth,
                             const Recording& rows) {
  Eigen::MatrixXd J(0, 0);
  Eigen::MatrixXd before;
  for (int row = 0; row < rows.num_rows(); ++row) {
    const Eigen::MatrixXd now = RowJacobian(spec, truth, rows, row);
    const bool pair = row > 0 && rows.edge(row) == rows.edge(row - 1) && !rows.test(row);
    if (pair) {
      J.conservativeResize(J.rows() + 3, now.cols());
      J.bottomRows(3) = now - before;
    }
    before = now;
  }
  return J;
}

}  // namespace dhcal::independent
