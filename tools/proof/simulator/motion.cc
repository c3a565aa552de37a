#include "tools/proof/simulator/motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/units.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSecondsPerPose = 40;
constexpr double kResolution = 1e-4 * kDegree;  // the controller's display

Motion Prepared(const Arm& arm, int poses) {
  Motion motion;
  motion.q.resize(poses, arm.num_joints());
  motion.time = VectorXd::LinSpaced(poses, 0, kSecondsPerPose * (poses - 1));
  motion.payload = VectorXd::Constant(poses, arm.payload);
  motion.run.assign(static_cast<std::size_t>(poses), 1);
  motion.test.assign(static_cast<std::size_t>(poses), false);
  return motion;
}

VectorXd RandomPose(const Arm& arm, const VectorXd& half, Rng* rng) {
  VectorXd q(arm.num_joints());
  for (Index j = 0; j < q.size(); ++j) {
    q[j] = rng->Uniform(arm.middle[j] - half[j], arm.middle[j] + half[j]);
  }
  return q;
}

void RoundLikeTheController(Motion* motion) {
  motion->q = (motion->q / kResolution).array().round().matrix() * kResolution;
}

}  // namespace

Motion RandomPoses(const Arm& arm, const VectorXd& half_range, int poses, Rng* rng) {
  Motion motion = Prepared(arm, poses);
  for (Index k = 0; k < poses; ++k) motion.q.row(k) = RandomPose(arm, half_range, rng).transpose();
  RoundLikeTheController(&motion);
  return motion;
}

Motion Series(const Arm& arm, int series, int length, Rng* rng) {
  Motion motion = Prepared(arm, series * length);
  for (int s = 0; s < series; ++s) {
    const VectorXd start = RandomPose(arm, 0.8 * arm.wide, rng);
    VectorXd step(arm.num_joints());
    for (Index j = 0; j < step.size(); ++j) step[j] = rng->Uniform(-2.5, 2.5) * kDegree;
    for (int k = 0; k < length; ++k) {
      const Index row = static_cast<Index>(s) * length + k;
      motion.q.row(row) = (start + k * step).transpose();
      motion.run[static_cast<std::size_t>(row)] = s + 1;
    }
  }
  RoundLikeTheController(&motion);
  return motion;
}

Motion Passes(const Arm& arm, int poses, Rng* rng) {
  constexpr double kSlow = 0.1, kFast = 0.5;  // [rad/s] of the quickest joint
  Motion motion = RandomPoses(arm, arm.wide, poses, rng);
  motion.speed.resize(poses, arm.num_joints());
  for (Index k = 0; k < poses; ++k) {
    const VectorXd way = RandomPose(arm, arm.wide, rng) - motion.q.row(k).transpose();
    const double speed = k % 2 == 0 ? kSlow : kFast;
    motion.speed.row(k) = (way * speed / std::max(way.cwiseAbs().maxCoeff(), 1e-9)).transpose();
  }
  return motion;
}

Motion PayloadPairs(const Arm& arm, int pairs, double payload, Rng* rng) {
  const Motion once = RandomPoses(arm, arm.wide, pairs, rng);
  Motion motion = Prepared(arm, 2 * pairs);
  motion.payload_varies = true;
  for (Index k = 0; k < pairs; ++k) {
    motion.q.row(2 * k) = motion.q.row(2 * k + 1) = once.q.row(k);
    motion.payload[2 * k] = 0;
    motion.payload[2 * k + 1] = payload;
  }
  return motion;
}

void SortByFirstJoint(Motion* motion) {
  std::vector<Index> order(static_cast<std::size_t>(motion->num_poses()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return motion->q(a, 0) < motion->q(b, 0);
  });
  const MatrixXd q = motion->q;
  for (std::size_t k = 0; k < order.size(); ++k) {
    motion->q.row(static_cast<Index>(k)) = q.row(order[k]);
  }
}

void KeepForTest(int stride, int group, Motion* motion) {
  for (int k = 0; k < motion->num_poses(); ++k) {
    motion->test[static_cast<std::size_t>(k)] = (k / group) % stride == stride - 1;
  }
}

}  // namespace dhcal::concealed
