#include "tests/support/recorder.h"

#include <cmath>
#include <limits>

#include "core/kinematics/slots.h"
#include "core/math/rotation.h"
#include "problems/parameter_set.h"
#include "residuals/registry.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

Eigen::Vector3d NormalVector(double sigma, Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

Eigen::Vector3d PointOf(const Eigen::Matrix4d& X) { return X.block<3, 1>(0, 3); }

/// Readings without noise of one kind for two consecutive poses, as one vector.
Eigen::VectorXd WhatIsRead(const ProblemSpec& spec,
                           const Eigen::Matrix4d& before,
                           const Eigen::Matrix4d& now) {
  if (spec.measurement.kind.name == "distance") {
    Eigen::VectorXd distances(static_cast<Eigen::Index>(spec.measurement.anchors.size()));
    for (Eigen::Index k = 0; k < distances.size(); ++k) {
      const Anchor& anchor = spec.measurement.anchors[static_cast<std::size_t>(k)];
      distances[k] = (PointOf(now) - anchor.p_WA).norm();
    }
    return distances;
  }
  if (spec.measurement.kind.name == "adjacent_position") {
    return PointOf(now) - PointOf(before);
  }
  return PointOf(now);
}

}  // namespace

Eigen::Matrix4d TrueRobot::Pose(const Eigen::VectorXd& q) const {
  return X_VW.matrix() * independent::ForwardKinematics<double>(nominal, q, delta);
}

TrueRobot MakeTrueRobot(const RobotModel& nominal, std::uint64_t seed) {
  Rng rng(seed);
  TrueRobot robot;
  robot.nominal = nominal;
  const SlotLayout slots(nominal.num_joints());
  robot.delta = Eigen::VectorXd::Zero(slots.size());
  const std::vector<int> needs_beta = JointsThatNeedBeta(nominal);
  for (int joint = 0; joint < nominal.num_joints(); ++joint) {
    robot.delta[slots.joint(joint, JointSlot::kTheta)] = 1e-3 * rng.Normal();
    robot.delta[slots.joint(joint, JointSlot::kAlpha)] = 5e-4 * rng.Normal();
    robot.delta[slots.joint(joint, JointSlot::kA)] = 3e-4 * rng.Normal();
    robot.delta[slots.joint(joint, JointSlot::kD)] = 3e-4 * rng.Normal();
  }
  for (const int joint : needs_beta) {
    robot.delta[slots.joint(joint, JointSlot::kBeta)] = 5e-4 * rng.Normal();
  }
  for (int k = 0; k < 3; ++k) robot.delta[slots.tool(k)] = 5e-3 * rng.Normal();
  for (int k = 3; k < 6; ++k) robot.delta[slots.tool(k)] = 0.2 * rng.Normal();
  robot.X_VW = MakeFrame(NormalVector(2.0, &rng), NormalVector(1.5, &rng));
  return robot;
}

ProblemSpec MakeSpec(const RobotModel& nominal, const MeasurementKind& kind, NoiseKind noise) {
  ProblemSpec spec;
  spec.file = "made.yaml";
  spec.name = "made";
  spec.robot = nominal;
  spec.measurement.kind = kind;
  spec.measurement.noise = noise;
  spec.parameters.estimate = {"complete"};
  if (kind.name == "distance") {
    spec.measurement.anchors = {{"A", {1.5, 0.2, 0.1}},
                                {"B", {-0.3, 2, 0.4}},
                                {"C", {-1, -1, 1.5}},
                                {"D", {0.2, 0.1, -0.7}}};
  }
  return spec;
}

Recording Record(const TrueRobot& robot, const ProblemSpec& spec, const RecordingPlan& plan) {
  Rng rng(plan.seed);
  Recording recording;
  recording.file = "made.csv";
  const MeasurementKind kind = spec.measurement.kind;
  recording.q.resize(plan.poses, robot.nominal.num_joints());
  const bool displacements =
      kind.name == "adjacent_position" && spec.measurement.noise == NoiseKind::kIndependent;
  if (kind.name == "distance") {
    recording.distance.resize(plan.poses);
    for (const Anchor& anchor : spec.measurement.anchors) {
      recording.anchor_names.push_back(anchor.name);
    }
  } else if (displacements) {
    recording.displacement.setConstant(plan.poses, 3, std::numeric_limits<double>::quiet_NaN());
  } else {
    recording.p_WQ.resize(plan.poses, 3);
    if (kind.name == "pose") recording.quaternion.resize(plan.poses, 4);
  }
  Eigen::Matrix4d before;
  for (int k = 0; k < plan.poses; ++k) {
    const Eigen::VectorXd q = RandomJoints(robot.nominal, &rng);
    recording.q.row(k) = q;
    const Eigen::Matrix4d X = robot.Pose(q);
    if (kind.name == "distance") {
      const int anchor = k % static_cast<int>(spec.measurement.anchors.size());
      recording.anchor_idx.push_back(anchor);
      recording.distance[k] = WhatIsRead(spec, X, X)[anchor] + plan.sigma * rng.Normal();
    } else if (displacements) {
      if (k > 0) {
        recording.displacement.row(k) =
            WhatIsRead(spec, before, X) + NormalVector(plan.sigma, &rng);
      }
    } else {
      recording.p_WQ.row(k) = PointOf(X) + NormalVector(plan.sigma, &rng);
    }
    if (kind.name == "pose") {
      const Eigen::Vector3d turn = NormalVector(plan.sigma_rotation, &rng);
      const Eigen::Matrix3d R = ExpSO3<double>(turn) * X.topLeftCorner<3, 3>();
      const Eigen::Quaterniond rotation(R);
      recording.quaternion.row(k) << rotation.w(), rotation.x(), rotation.y(), rotation.z();
    }
    before = X;
  }
  return recording;
}

double PredictionError(const TrueRobot& truth,
                       const ProblemSpec& spec,
                       const RobotModel& calibrated,
                       std::uint64_t seed) {
  Rng rng(seed);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(SlotLayout(calibrated.num_joints()).size());
  constexpr int kPoses = 500;
  double squares = 0;
  Eigen::Matrix4d true_before, before;
  for (int k = 0; k <= kPoses; ++k) {
    const Eigen::VectorXd q = RandomJoints(calibrated, &rng);
    const Eigen::Matrix4d true_now = truth.Pose(q);
    const Eigen::Matrix4d now = independent::ForwardKinematics<double>(calibrated, q, none);
    if (k > 0) {
      squares +=
          (WhatIsRead(spec, before, now) - WhatIsRead(spec, true_before, true_now)).squaredNorm();
    }
    before = now;
    true_before = true_now;
  }
  return std::sqrt(squares / kPoses);
}

}  // namespace dhcal
