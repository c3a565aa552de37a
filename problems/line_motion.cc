#include "problems/line_motion.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/math/rotation.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The way to a line's start is gone in so many steps, so that no branch is left on it.
constexpr int kApproachSteps = 25;

/// A line with the words that messages have for it.
struct NamedLine {
  std::string name;  // "edge 'north'", "line 2"
  MotionLine line;
};

/// A line over an edge; about the face's normal the tool is turned as little as may be from where
/// it is at home.
MotionLine LineOver(const Isometry3d& X_WE, const AlongEdges& along, const Isometry3d& X_WQ_home) {
  MotionLine line;
  const Vector3d z = -X_WE.linear().col(2);
  Vector3d x = X_WQ_home.linear().col(0);
  x -= z * z.dot(x);
  // At home the tool's x axis may be along the normal: then along the edge.
  if (x.norm() < 0.1) x = X_WE.linear().col(0);
  x.normalize();
  line.X_WQ.linear() << x, z.cross(x), z;
  line.X_WQ.translation() = X_WE * Vector3d(-along.length / 2, 0, along.stand_off);
  line.p_WQ_end = X_WE * Vector3d(along.length / 2, 0, along.stand_off);
  return line;
}

/// The lines, and the labels of their rows in `rows`.
std::vector<NamedLine> LinesOf(const ProblemSpec& spec,
                               const Isometry3d& X_WQ_home,
                               Recording* rows) {
  const MotionSpec& motion = spec.simulate->motion;
  std::vector<NamedLine> lines;
  for (std::size_t k = 0; k < motion.lines.size(); ++k) {
    rows->run_names.push_back(fmt::format("line{}", k + 1));
    rows->run_idx.insert(rows->run_idx.end(), motion.num_poses, static_cast<int>(k));
    lines.push_back({fmt::format("line {}", k + 1), motion.lines[k]});
  }
  if (!motion.along_edges) return lines;
  for (const Edge& edge : spec.robot.edges) {
    if (!edge.X_WE) continue;
    const auto idx = static_cast<int>(rows->edge_names.size());
    rows->edge_names.push_back(edge.name);
    rows->edge_idx.insert(rows->edge_idx.end(), motion.num_poses, idx);
    lines.push_back({fmt::format("edge '{}'", Printable(edge.name)),
                     LineOver(*edge.X_WE, *motion.along_edges, X_WQ_home)});
  }
  return lines;
}

/// The pose a share of the way from one to another.
Isometry3d Between(const Isometry3d& from, const Isometry3d& to, double share) {
  const Vector3d turn = share * LogSO3(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  Isometry3d X = Isometry3d::Identity();
  X.linear() = ExpSO3<double>(turn) * from.linear();
  X.translation() = from.translation() + share * (to.translation() - from.translation());
  return X;
}

/// The nominal robot on its way.
class Walker {
 public:
  explicit Walker(const ProblemSpec& spec)
      : inverse_(spec.robot),
        state_{VectorXd::Zero(inverse_.chain().slots().size()),
               {spec.robot.X_WB, spec.robot.first_X_TQ()}},
        q_(spec.simulate->motion.home) {}

  const VectorXd& q() const { return q_; }
  Isometry3d Pose() const { return inverse_.chain().Pose<double>(q_, state_.delta, state_.ends); }
  /// Why it cannot go there, or "".
  std::string GoTo(const Isometry3d& X_WQ) {
    const InverseSolution solution = inverse_.Solve(X_WQ, state_, q_);
    if (!solution.found) return solution.reason;
    q_ = solution.q;
    return "";
  }
  /// Goes near a pose; singular places on the way are passed by.
  void Approach(const Isometry3d& X_WQ) {
    const Isometry3d from = Pose();
    for (int k = 1; k < kApproachSteps; ++k) {
      GoTo(Between(from, X_WQ, static_cast<double>(k) / kApproachSteps));
    }
  }

 private:
  InverseKinematics inverse_;
  ChainState state_;
  VectorXd q_;
};

Isometry3d PoseOn(const MotionLine& line, double share, double tilt, Rng* rng) {
  Isometry3d X = line.X_WQ;
  X.translation() += share * (line.p_WQ_end - line.X_WQ.translation());
  X.linear() = X.linear() * RandomTilt(tilt, rng);
  return X;
}

}  // namespace

Eigen::Matrix3d RandomTilt(double most, Rng* rng) {
  Vector3d turn;
  for (double& component : turn) component = rng->Uniform(-most, most);
  return ExpSO3<double>(turn);
}

std::optional<Recording> LineMotion(const ProblemSpec& spec, Rng* rng, Diagnostics* diagnostics) {
  const MotionSpec& motion = spec.simulate->motion;
  Recording rows;
  const Walker home(spec);
  const std::vector<NamedLine> lines = LinesOf(spec, home.Pose(), &rows);
  rows.q.resize(static_cast<Eigen::Index>(lines.size()) * motion.num_poses,
                spec.robot.num_joints());
  Eigen::Index row = 0;
  for (const NamedLine& named : lines) {
    // Every line from home, so that one does not depend on those before it.
    Walker robot = home;
    robot.Approach(named.line.X_WQ);
    for (int k = 0; k < motion.num_poses; ++k) {
      const double share =
          motion.num_poses > 1 ? static_cast<double>(k) / (motion.num_poses - 1) : 0;
      const std::string refusal = robot.GoTo(PoseOn(named.line, share, motion.tilt, rng));
      if (!refusal.empty()) {
        diagnostics->Error({spec.file},
                           fmt::format("simulate.motion: pose {} of {}: {}; move the line, tilt "
                                       "the tool less or give another home",
                                       k + 1,
                                       named.name,
                                       refusal));
        return std::nullopt;
      }
      rows.q.row(row++) = robot.q();
    }
  }
  return rows;
}

}  // namespace dhcal
