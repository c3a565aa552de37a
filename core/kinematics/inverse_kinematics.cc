#include "core/kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/rotation.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kFreedoms = 6;  // of a pose
// Largest move of any joint in one step [rad, or reaches]: larger ones leave the branch.
constexpr double kLargestStep = 0.2;
constexpr double kFirstDamping = 1e-6, kLeastDamping = 1e-12, kMostDamping = 1e3;
// Smallest singular value of the Jacobian with lengths over the reach: below, an error of a
// thousandth of a tolerance moves a joint by the tolerance.
constexpr double kSingular = 1e-3;
// What a chain of fewer than six joints may leave of the orientation [rad]; more is no error of its
// geometry but another pose.
constexpr double kMostTurnLeft = 0.05;
// A joint's step so small settles the orientation of such a chain.
constexpr double kStillStep = 1e-12;

/// The largest length of a row and of what moves along its joint [m]; 1 where the robot has none.
double ReachOf(const RobotModel& robot) {
  double reach = robot.X_TQ.translation().norm();
  for (const JointRow& row : robot.joints) reach += std::hypot(row.a, row.d);
  return reach > 0 ? reach : 1.0;
}

MatrixXd PseudoInverse(const MatrixXd& A) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(kSingular);
  decomposition.compute(A);
  return decomposition.pseudoInverse();
}

}  // namespace

/// How far a state is from the target, and how the joints change that.
struct InverseKinematics::Errors {
  Vector6 e;                          // position over the reach, rotation [rad]
  MatrixXd J;                         // 6 x n, of the pose by q
  double position = 0, rotation = 0;  // [m], [rad]
};

InverseKinematics::InverseKinematics(const RobotModel& robot)
    : robot_(robot), chain_(robot), reach_(ReachOf(robot)) {}

InverseKinematics::Errors InverseKinematics::ErrorsAt(const Eigen::Isometry3d& X_WQ,
                                                      const ChainState& state,
                                                      const VectorXd& q) const {
  PoseWithDerivatives pose;
  chain_.PoseAndDerivatives(q, state.delta, state.ends, &pose);
  Errors errors;
  const Eigen::Vector3d move = X_WQ.translation() - pose.p_WQ;
  const Eigen::Vector3d turn = LogSO3(X_WQ.linear() * pose.R_WQ.transpose());
  errors.e << move / reach_, turn;
  errors.position = move.norm();
  errors.rotation = turn.norm();
  errors.J.resize(kFreedoms, chain_.num_joints());
  for (int joint = 0; joint < chain_.num_joints(); ++joint) {
    const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
    const bool turns = row.type == JointType::kRevolute;
    const int slot = chain_.slots().joint(joint, turns ? JointSlot::kTheta : JointSlot::kD);
    // Slides in reaches, so that steps of all joints compare.
    const double unit = row.sign * (turns ? 1 : reach_);
    errors.J.col(joint) << unit * pose.J_p.col(slot) / reach_, unit * pose.J_w.col(slot);
  }
  return errors;
}

VectorXd InverseKinematics::Step(const Errors& errors, double damping) const {
  VectorXd step;
  if (chain_.num_joints() >= kFreedoms) {
    Eigen::Matrix<double, 6, 6> normal = errors.J * errors.J.transpose();
    normal.diagonal().array() += damping * damping;
    step = errors.J.transpose() * normal.ldlt().solve(errors.e);
  } else {
    const MatrixXd J_p = errors.J.topRows<3>(), J_w = errors.J.bottomRows<3>();
    const MatrixXd to_place = PseudoInverse(J_p);
    const Index n = J_p.cols();
    const MatrixXd rest = MatrixXd::Identity(n, n) - to_place * J_p;
    step = to_place * errors.e.head<3>();
    step += rest * (PseudoInverse(J_w * rest) * (errors.e.tail<3>() - J_w * step));
    step /= 1 + damping;
  }
  const double largest = step.lpNorm<Eigen::Infinity>();
  if (largest > kLargestStep) step *= kLargestStep / largest;
  for (int joint = 0; joint < chain_.num_joints(); ++joint) {
    const bool slides =
        robot_.joints[static_cast<std::size_t>(joint)].type == JointType::kPrismatic;
    if (slides) step[joint] *= reach_;
  }
  return step;
}

bool InverseKinematics::IsSettled(const Errors& errors,
                                  const VectorXd& step,
                                  const InverseOptions& options) const {
  if (errors.position > options.position_tolerance) return false;
  if (errors.rotation <= options.rotation_tolerance) return true;
  const bool may_leave_a_turn = chain_.num_joints() < kFreedoms && errors.rotation < kMostTurnLeft;
  return may_leave_a_turn && step.lpNorm<Eigen::Infinity>() < kStillStep;
}

InverseSolution InverseKinematics::Descend(const Eigen::Isometry3d& X_WQ,
                                           const ChainState& state,
                                           const VectorXd& seed,
                                           const InverseOptions& options,
                                           bool limited) const {
  const auto within = [&](VectorXd q) {
    for (int joint = 0; limited && joint < q.size(); ++joint) {
      const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
      q[joint] = std::min(std::max(q[joint], row.lower), row.upper);
    }
    return q;
  };
  InverseSolution solution;
  solution.q = within(seed);
  Errors errors = ErrorsAt(X_WQ, state, solution.q);
  double damping = kFirstDamping;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    // A joint at its limit that is pushed against it takes no part.
    Errors movable = errors;
    for (int turn = 0; limited && turn < chain_.num_joints(); ++turn) {
      const VectorXd step = Step(movable, damping);
      const VectorXd stopped = solution.q + step - within(solution.q + step);
      Index worst = 0;
      if (!(stopped.cwiseAbs().maxCoeff(&worst) > 0)) break;
      movable.J.col(worst).setZero();
    }
    const VectorXd step = Step(movable, damping);
    solution.found = IsSettled(errors, step, options);
    if (solution.found) break;
    const VectorXd q = within(solution.q + step);
    const Errors there = ErrorsAt(X_WQ, state, q);
    // Task priority brings the point to its place first; its errors alone must fall.
    const bool fewer = chain_.num_joints() < kFreedoms;
    const bool better = fewer || there.e.squaredNorm() < errors.e.squaredNorm();
    damping = std::min(std::max(damping * (better ? 0.1 : 10), kLeastDamping), kMostDamping);
    if (!better && damping >= kMostDamping) break;
    if (!better) continue;
    solution.q = q;
    errors = there;
  }
  solution.position_error = errors.position;
  solution.rotation_error = errors.rotation;
  return solution;
}

int InverseKinematics::TurnIntoLimits(VectorXd* q) const {
  int beyond = -1;
  for (int joint = chain_.num_joints() - 1; joint >= 0; --joint) {
    const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
    double& value = (*q)[joint];
    if (value >= row.lower && value <= row.upper) continue;
    const double turn = 2 * kPi;
    const double turned = value > row.upper ? value - turn * std::ceil((value - row.upper) / turn)
                                            : value + turn * std::ceil((row.lower - value) / turn);
    const bool fits =
        row.type == JointType::kRevolute && turned >= row.lower && turned <= row.upper;
    if (fits) {
      value = turned;
    } else {
      beyond = joint;
    }
  }
  return beyond;
}

std::string InverseKinematics::BeyondLimit(int joint, double q) const {
  const JointRow& row = robot_.joints[static_cast<std::size_t>(joint)];
  const bool turns = row.type == JointType::kRevolute;
  const double unit = turns ? kDegree : kMillimetre;
  return fmt::format("{} would have to go to {:.2f} {}, beyond its limits {:g} to {:g} {}",
                     JointWords(robot_, joint + 1),
                     q / unit,
                     turns ? "deg" : "mm",
                     row.lower / unit,
                     row.upper / unit,
                     turns ? "deg" : "mm");
}

InverseSolution InverseKinematics::Solve(const Eigen::Isometry3d& X_WQ,
                                         const ChainState& state,
                                         const VectorXd& seed,
                                         const InverseOptions& options) const {
  InverseSolution solution = Descend(X_WQ, state, seed, options, /*limited=*/false);
  if (!solution.found) {
    solution.reason = fmt::format(
        "out of reach: {:.3g} mm and {:.3g} mrad remain from the given joint coordinates",
        solution.position_error / kMillimetre,
        solution.rotation_error / kMilliradian);
    return solution;
  }
  const int beyond = TurnIntoLimits(&solution.q);
  if (beyond >= 0) {
    const std::string reason = BeyondLimit(beyond, solution.q[beyond]);
    InverseSolution limited = Descend(X_WQ, state, seed, options, /*limited=*/true);
    if (!limited.found) {
      solution.found = false;
      solution.reason = reason;
      return solution;
    }
    solution = limited;
  }
  const Eigen::JacobiSVD<MatrixXd> svd(ErrorsAt(X_WQ, state, solution.q).J);
  const double least = svd.singularValues().tail<1>()[0];
  if (least < kSingular) {
    solution.found = false;
    solution.reason = fmt::format(
        "singular: the joints cannot move the tool in every direction there (smallest singular "
        "value {:.1g}, at least {:g} is needed)",
        least,
        kSingular);
  }
  return solution;
}

}  // namespace dhcal
