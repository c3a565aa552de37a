#include "problems/task/region.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/kinematics/inverse_kinematics.h"

namespace dhcal {
namespace {

// So many draws from the joints' range per pose wanted; below that, inverse kinematics helps.
constexpr int kDrawsPerPose = 60;
constexpr int kTriesPerPose = 12;

Eigen::Vector3d PointIn(const TaskBox& box, Rng* rng) {
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = rng->Uniform(box.low[k], box.high[k]);
  return p;
}

}  // namespace

JointRange::JointRange(const RobotModel& robot)
    : low(robot.num_joints()), high(robot.num_joints()) {
  for (int joint = 0; joint < robot.num_joints(); ++joint) {
    const JointRow& row = robot.joints[static_cast<std::size_t>(joint)];
    const double most = row.type == JointType::kRevolute ? kPi : 0.0;
    low[joint] = std::isfinite(row.lower) ? row.lower : -most;
    high[joint] = std::isfinite(row.upper) ? row.upper : most;
  }
}

Eigen::VectorXd JointRange::Draw(Rng* rng) const {
  Eigen::VectorXd q(low.size());
  for (Eigen::Index k = 0; k < q.size(); ++k) q[k] = rng->Uniform(low[k], high[k]);
  return q;
}

Eigen::MatrixXd DrawInBox(const RobotModel& robot,
                          const TaskBox& box,
                          int count,
                          std::uint64_t seed) {
  Rng rng(seed);
  const JointRange range(robot);
  const InverseKinematics inverse(robot);
  const ChainState state{Eigen::VectorXd::Zero(inverse.chain().slots().size()),
                         {Eigen::Isometry3d::Identity(), robot.first_X_TQ()}};
  std::vector<Eigen::VectorXd> found;
  const auto full = [&] { return static_cast<int>(found.size()) == count; };
  for (int draw = 0; draw < kDrawsPerPose * count && !full(); ++draw) {
    Eigen::VectorXd q = range.Draw(&rng);
    const Eigen::Isometry3d X_BQ = inverse.chain().Pose<double>(q, state.delta, state.ends);
    if (box.Holds(X_BQ.translation())) found.push_back(std::move(q));
  }
  for (int attempt = 0; attempt < kTriesPerPose * count && !full(); ++attempt) {
    const Eigen::VectorXd from = range.Draw(&rng);
    Eigen::Isometry3d X_BQ = inverse.chain().Pose<double>(from, state.delta, state.ends);
    X_BQ.translation() = PointIn(box, &rng);
    const InverseSolution solution = inverse.Solve(X_BQ, state, from);
    if (solution.found) found.push_back(solution.q);
  }
  Eigen::MatrixXd poses(static_cast<Eigen::Index>(found.size()), robot.num_joints());
  for (Eigen::Index row = 0; row < poses.rows(); ++row) {
    poses.row(row) = found[static_cast<std::size_t>(row)].transpose();
  }
  return poses;
}

}  // namespace dhcal
