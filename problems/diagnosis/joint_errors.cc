#include "problems/diagnosis/joint_errors.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/kinematics/dh_chain.h"

namespace dhcal {
namespace {

/// Of the longest lever arm: at a shorter one a millimetre is too large an angle to say anything.
constexpr double kShortArm = 0.25;

/// The slot that a joint's coordinate adds to.
int SlotOfMotion(const Calibration& c, int joint_idx) {
  const JointRow& row = c.spec.robot.joints[static_cast<std::size_t>(joint_idx)];
  return c.chain.slots().joint(
      joint_idx, row.type == JointType::kRevolute ? JointSlot::kTheta : JointSlot::kD);
}

/// True if an estimated effect has the slot among its own.
bool IsMoved(int slot, const Calibration& c) {
  return std::any_of(c.effect_columns.begin(), c.effect_columns.end(), [&](const auto& column) {
    return std::any_of(column.slots.begin(), column.slots.end(), [&](const SlotWeights& weights) {
      return weights.slot == slot;
    });
  });
}

/// What the estimated effects add to a slot, per row of the recording.
Eigen::VectorXd AddedTo(int slot, const Calibration& c, const Eigen::VectorXd& state) {
  Eigen::VectorXd added = Eigen::VectorXd::Zero(c.recording.num_rows());
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const Parameter& p = c.parameters[k];
    if (p.effect_column < 0) continue;
    for (const SlotWeights& weights : c.ColumnOf(p).slots) {
      if (weights.slot == slot) added += weights.weight * state[static_cast<Eigen::Index>(k)];
    }
  }
  return added;
}

/// A row of the delivered model: its residual [m], and how the point moves per unit of each slot.
struct PointOfRow {
  int row_idx;
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, Eigen::Dynamic> J;
};

std::vector<PointOfRow> PointsOf(const Calibration& c,
                                 const Eigen::VectorXd& state,
                                 const std::vector<RowResidual>& residuals) {
  std::vector<PointOfRow> points;
  for (const RowResidual& row : residuals) {
    if (!row.set_aside.empty() || row.predicted_effects.size() == 0) continue;
    PoseWithDerivatives pose;
    c.chain.PoseAndDerivatives(c.recording.q.row(row.row_idx).transpose(),
                               c.SlotDeltas(state, row.row_idx),
                               c.frames.ends(c.Labels(row.row_idx)),
                               &pose);
    points.push_back({row.row_idx, row.residual.head<3>(), std::move(pose.J_p)});
  }
  return points;
}

}  // namespace

std::vector<JointErrors> JointErrorsOf(const Calibration& calibration,
                                       const Eigen::VectorXd& state,
                                       const std::vector<RowResidual>& residuals) {
  const MeasurementKind& kind = calibration.measurement->kind();
  if (!kind.is_point() || kind.pairs) return {};
  std::vector<JointErrors> all;
  std::optional<std::vector<PointOfRow>> points;
  for (int joint = 0; joint < calibration.chain.num_joints(); ++joint) {
    const int slot = SlotOfMotion(calibration, joint);
    if (!IsMoved(slot, calibration)) continue;
    const Eigen::VectorXd added = AddedTo(slot, calibration, state);
    if (!points) points = PointsOf(calibration, state, residuals);
    double longest = 0;
    for (const PointOfRow& p : *points) longest = std::max(longest, p.J.col(slot).norm());
    JointErrors& errors = all.emplace_back();
    errors.joint_idx = joint;
    for (const PointOfRow& p : *points) {
      const Eigen::Vector3d arm = p.J.col(slot);
      if (arm.norm() <= kShortArm * longest) continue;
      errors.q.push_back(calibration.recording.q(p.row_idx, joint));
      errors.modelled.push_back(added[p.row_idx]);
      errors.error.push_back(added[p.row_idx] + arm.dot(p.residual) / arm.squaredNorm());
    }
  }
  return all;
}

}  // namespace dhcal
