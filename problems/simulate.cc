#include "problems/simulate.h"

#include <algorithm>
#include <limits>

#include <glog/logging.h>

#include "core/base/rng.h"
#include "core/io/recording_reader.h"
#include "core/kinematics/dh_chain.h"

namespace dhcal {
namespace {

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

std::optional<Eigen::MatrixXd> JointCoordinates(const ProblemSpec& spec,
                                                Rng* rng,
                                                Diagnostics* diagnostics) {
  const MotionSpec& motion = spec.simulate->motion;
  if (motion.kind == MotionKind::kFile) {
    const std::optional<Recording> file =
        ReadRecording(motion.file, spec.robot.joints, diagnostics);
    if (!file) return std::nullopt;
    return file->q;
  }
  Eigen::MatrixXd q(motion.num_poses, spec.robot.num_joints());
  for (int pose = 0; pose < motion.num_poses; ++pose) {
    for (int joint = 0; joint < q.cols(); ++joint) {
      q(pose, joint) = motion.kind == MotionKind::kIncrements
                           ? motion.home[joint] + pose * motion.increments[joint]
                           : rng->Uniform(motion.lower[joint], motion.upper[joint]);
    }
  }
  return q;
}

Eigen::Vector3d NormalVector(double sigma, Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

/// Fills the columns of a recording whose joint columns and labels stand.
class Measurer {
 public:
  Measurer(const ProblemSpec& spec, Rng* rng) : spec_(spec), rng_(rng) {}

  void Measure(const std::vector<Eigen::Isometry3d>& X_WQ, Recording* recording) const {
    switch (spec_.measurement.kind) {
      case MeasurementKind::kPosition:
        return Positions(X_WQ, recording);
      case MeasurementKind::kPose:
        Positions(X_WQ, recording);
        return Orientations(X_WQ, recording);
      case MeasurementKind::kDistance:
        return Distances(X_WQ, recording);
      case MeasurementKind::kAdjacentPosition:
        // A shared error belongs to the pose, an independent one to the displacement.
        if (spec_.measurement.noise == NoiseKind::kSharedPose) return Positions(X_WQ, recording);
        return Displacements(X_WQ, recording);
    }
  }

 private:
  double noise() const { return spec_.simulate->noise; }

  void Positions(const std::vector<Eigen::Isometry3d>& X_WQ, Recording* recording) const {
    recording->p_WQ.resize(static_cast<Eigen::Index>(X_WQ.size()), 3);
    for (std::size_t k = 0; k < X_WQ.size(); ++k) {
      recording->p_WQ.row(static_cast<Eigen::Index>(k)) =
          X_WQ[k].translation() + NormalVector(noise(), rng_);
    }
  }

  void Orientations(const std::vector<Eigen::Isometry3d>& X_WQ, Recording* recording) const {
    recording->quaternion.resize(static_cast<Eigen::Index>(X_WQ.size()), 4);
    for (std::size_t k = 0; k < X_WQ.size(); ++k) {
      const Eigen::Vector3d turn = NormalVector(spec_.simulate->noise_rotation, rng_);
      const Eigen::Quaterniond q(ExpSO3<double>(turn) * X_WQ[k].linear());
      recording->quaternion.row(static_cast<Eigen::Index>(k)) << q.w(), q.x(), q.y(), q.z();
    }
  }

  void Displacements(const std::vector<Eigen::Isometry3d>& X_WQ, Recording* recording) const {
    const int num_targets = std::max<int>(static_cast<int>(recording->target_names.size()), 1);
    recording->displacement.setConstant(static_cast<Eigen::Index>(X_WQ.size()), 3, kBlank);
    for (int k = num_targets; k < recording->num_rows(); ++k) {
      const auto now = static_cast<std::size_t>(k);
      const auto before = static_cast<std::size_t>(k - num_targets);
      recording->displacement.row(k) =
          X_WQ[now].translation() - X_WQ[before].translation() + NormalVector(noise(), rng_);
    }
  }

  void Distances(const std::vector<Eigen::Isometry3d>& X_WQ, Recording* recording) const {
    const std::vector<Anchor>& anchors = spec_.measurement.anchors;
    CHECK(!anchors.empty());
    for (const Anchor& anchor : anchors) recording->anchor_names.push_back(anchor.name);
    recording->distance.resize(static_cast<Eigen::Index>(X_WQ.size()));
    for (std::size_t k = 0; k < X_WQ.size(); ++k) {
      const std::size_t anchor = k % anchors.size();
      recording->anchor_idx.push_back(static_cast<int>(anchor));
      recording->distance[static_cast<Eigen::Index>(k)] =
          (X_WQ[k].translation() - anchors[anchor].p_WA).norm() + noise() * rng_->Normal();
    }
  }

  const ProblemSpec& spec_;
  Rng* rng_;
};

void Add(const Eigen::VectorXd& errors,
         JointSlot kind,
         const SlotLayout& slots,
         Eigen::VectorXd* delta) {
  for (int joint = 0; joint < errors.size(); ++joint) {
    (*delta)[slots.joint(joint, kind)] = errors[joint];
  }
}

}  // namespace

Eigen::VectorXd ErrorSlots(const RobotModel& robot, const SimulationSpec& simulation) {
  const SlotLayout slots(robot.num_joints());
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(slots.size());
  Add(simulation.theta, JointSlot::kTheta, slots, &delta);
  Add(simulation.alpha, JointSlot::kAlpha, slots, &delta);
  Add(simulation.a, JointSlot::kA, slots, &delta);
  Add(simulation.d, JointSlot::kD, slots, &delta);
  Add(simulation.beta, JointSlot::kBeta, slots, &delta);
  if (simulation.base.size() > 0) delta.segment<6>(slots.base(0)) = simulation.base;
  if (simulation.tool.size() > 0) delta.segment<6>(slots.tool(0)) = simulation.tool;
  return delta;
}

std::optional<Recording> SimulateRecording(const ProblemSpec& spec, Diagnostics* diagnostics) {
  CHECK(spec.simulate.has_value());
  Rng rng(spec.simulate->seed);
  const std::optional<Eigen::MatrixXd> q = JointCoordinates(spec, &rng, diagnostics);
  if (!q) return std::nullopt;

  const RobotModel& robot = spec.robot;
  const DhChain chain(robot);
  const Eigen::VectorXd delta = ErrorSlots(robot, *spec.simulate);
  const int num_targets = std::max<int>(static_cast<int>(robot.targets.size()), 1);
  Recording recording;
  recording.file = spec.file;
  recording.q.resize(q->rows() * num_targets, q->cols());
  for (const Target& target : robot.targets) recording.target_names.push_back(target.name);
  std::vector<Eigen::Isometry3d> X_WQ;
  for (int row_idx = 0; row_idx < recording.num_rows(); ++row_idx) {
    const int target = row_idx % num_targets;
    recording.q.row(row_idx) = q->row(row_idx / num_targets);
    if (!robot.targets.empty()) recording.target_idx.push_back(target);
    const EndFrames ends{
        robot.X_WB,
        robot.targets.empty() ? robot.X_TQ : robot.targets[static_cast<std::size_t>(target)].X_TQ};
    X_WQ.push_back(chain.Pose<double>(recording.q.row(row_idx).transpose(), delta, ends));
  }
  Measurer(spec, &rng).Measure(X_WQ, &recording);
  return recording;
}

}  // namespace dhcal
