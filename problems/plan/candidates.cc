#include "problems/plan/candidates.h"

#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/math/rotation.h"
#include "problems/line_motion.h"
#include "problems/task/region.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kTriesPerEdge = 200;
constexpr int kTriesPerPoint = 500;

bool IsIn(const std::optional<TaskBox>& volume, const Vector3d& p_BQ) {
  return !volume || volume->Holds(p_BQ);
}

void Append(const VectorXd& q, int group, Candidates* candidates) {
  Eigen::MatrixXd& rows = candidates->rows.q;
  rows.conservativeResize(rows.rows() + 1, q.size());
  rows.bottomRows(1) = q.transpose();
  candidates->group_of_row.push_back(group);
}

/// Lines over edges that a robot can go along.
class EdgeDrawer {
 public:
  EdgeDrawer(const RobotModel& robot, const EdgePlan& plan)
      : inverse_(robot),
        state_{VectorXd::Zero(inverse_.chain().slots().size()),
               {Isometry3d::Identity(), robot.first_X_TQ()}},
        plan_(plan) {}

  /// The point of the nominal robot in its base.
  Isometry3d X_BQ(const VectorXd& q) const {
    return inverse_.chain().Pose<double>(q, state_.delta, state_.ends);
  }

  /// An edge whose middle is where the tool stands at `q`, turned at random about the vertical of
  /// the base and sloped.
  Isometry3d Placement(const VectorXd& q, Rng* rng) const {
    const double roll = rng->Uniform(-plan_.slope, plan_.slope);
    const double pitch = rng->Uniform(-plan_.slope, plan_.slope);
    const double yaw = rng->Uniform(-kPi, kPi);
    Isometry3d X_BE = Isometry3d::Identity();
    X_BE.linear() = RotationFromRpy(Vector3d(roll, pitch, yaw));
    X_BE.translation() = X_BQ(q).translation() - plan_.stand_off * X_BE.linear().col(2);
    return X_BE;
  }

  /// Joint coordinates along the edge, one row per pose; none where the robot cannot follow.
  Eigen::MatrixXd Line(const Isometry3d& X_BE, const VectorXd& from, Rng* rng) const {
    Eigen::MatrixXd q(plan_.poses, from.size());
    const Isometry3d X_BQ_from = X_BQ(from);
    VectorXd at = from;
    for (int k = 0; k < plan_.poses; ++k) {
      const double share = plan_.poses > 1 ? static_cast<double>(k) / (plan_.poses - 1) : 0.5;
      const InverseSolution solution =
          inverse_.Solve(Over(X_BE, X_BQ_from, share, rng), state_, at);
      if (!solution.found) return {};
      at = solution.q;
      q.row(k) = at.transpose();
    }
    return q;
  }

 private:
  /// The tool over a place of the edge, its z axis into the face but for the tilt.
  Isometry3d Over(const Isometry3d& X_BE,
                  const Isometry3d& X_BQ_from,
                  double share,
                  Rng* rng) const {
    const Vector3d z = -X_BE.linear().col(2);
    Vector3d x = X_BQ_from.linear().col(0);
    x -= z * z.dot(x);
    if (x.norm() < 0.1) x = X_BE.linear().col(0);
    x.normalize();
    Isometry3d X = Isometry3d::Identity();
    X.linear() << x, z.cross(x), z;
    X.linear() = X.linear() * RandomTilt(plan_.tilt, rng);
    X.translation() = X_BE * Vector3d((share - 0.5) * plan_.length, 0, plan_.stand_off);
    return X;
  }

  InverseKinematics inverse_;
  ChainState state_;
  const EdgePlan& plan_;
};

}  // namespace

Candidates DrawPoses(const RobotModel& robot,
                     const std::optional<TaskBox>& volume,
                     int count,
                     Rng* rng) {
  const JointRange range(robot);
  const DhChain chain(robot);
  const VectorXd delta = VectorXd::Zero(chain.slots().size());
  const EndFrames ends{Isometry3d::Identity(), robot.first_X_TQ()};
  Candidates candidates;
  const int most = volume ? kTriesPerPoint * count : count;
  while (candidates.tried < most && candidates.count < count) {
    ++candidates.tried;
    const VectorXd q = range.Draw(rng);
    if (!IsIn(volume, chain.Pose<double>(q, delta, ends).translation())) continue;
    Append(q, candidates.count++, &candidates);
  }
  return candidates;
}

Candidates DrawEdges(const RobotModel& robot,
                     const std::optional<TaskBox>& volume,
                     const EdgePlan& plan,
                     int count,
                     Rng* rng) {
  const JointRange range(robot);
  const EdgeDrawer drawer(robot, plan);
  Candidates candidates;
  while (candidates.tried < kTriesPerEdge * count && candidates.count < count) {
    ++candidates.tried;
    const VectorXd from = range.Draw(rng);
    const Isometry3d X_BE = drawer.Placement(from, rng);
    const Vector3d half(plan.length / 2, 0, plan.stand_off);
    const Vector3d other(-half.x(), 0, half.z());
    if (!IsIn(volume, X_BE * half) || !IsIn(volume, X_BE * other)) continue;
    const Eigen::MatrixXd q = drawer.Line(X_BE, from, rng);
    if (q.rows() == 0) continue;
    const int group = candidates.count++;
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      Append(q.row(k).transpose(), group, &candidates);
      candidates.rows.edge_idx.push_back(group);
    }
    const std::string name = fmt::format("P{:02}", candidates.count);
    candidates.rows.edge_names.push_back(name);
    candidates.edges.push_back({name, robot.X_WB * X_BE});
  }
  return candidates;
}

Recording RowsOfGroups(const Candidates& candidates, const std::vector<int>& groups) {
  Recording picked;
  const Recording& all = candidates.rows;
  std::vector<int> rows;
  for (const int group : groups) {
    if (!candidates.edges.empty()) {
      picked.edge_names.push_back(all.edge_names[static_cast<std::size_t>(group)]);
    }
    for (std::size_t row = 0; row < candidates.group_of_row.size(); ++row) {
      if (candidates.group_of_row[row] != group) continue;
      rows.push_back(static_cast<int>(row));
      if (!candidates.edges.empty()) {
        picked.edge_idx.push_back(static_cast<int>(picked.edge_names.size()) - 1);
      }
    }
  }
  picked.q.resize(static_cast<Eigen::Index>(rows.size()), all.q.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    picked.q.row(static_cast<Eigen::Index>(k)) = all.q.row(rows[k]);
  }
  return picked;
}

}  // namespace dhcal
