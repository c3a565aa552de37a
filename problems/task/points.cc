#include "problems/task/points.h"

#include <utility>

#include <Eigen/QR>

#include "core/math/rotation.h"
#include "core/physics/registry.h"

namespace dhcal {
namespace {

/// The poses, and behind them those of the recording: whether an effect shows at few or similar
/// poses is no question here.
Recording WithRecorded(const Eigen::MatrixXd& q, const Recording& recording) {
  Recording rows;
  rows.q.resize(q.rows() + recording.q.rows(), recording.q.cols());
  rows.q << q, recording.q;
  return rows;
}

/// What effects do at the poses: columns of those that are estimated, amounts of those that are
/// held at values.
struct EffectsAtPoses {
  std::vector<EffectColumn> columns;  // as the calibration's; no slots where it is left out
  Eigen::MatrixXd held;               // slots x rows
  std::vector<std::string> left_out;
};

EffectsAtPoses EffectsOf(const Calibration& c, const Recording& rows) {
  EffectsAtPoses effects;
  effects.held = Eigen::MatrixXd::Zero(c.chain.slots().size(), rows.num_rows());
  effects.columns.resize(c.effect_columns.size());
  if (c.effects.empty()) return effects;
  const PhysicsContext context(c.spec.robot, rows, {c.frames.base({})});
  for (std::size_t k = 0; k < c.effects.size(); ++k) {
    const EffectRequest& request = c.effects[k];
    const Effect& effect = *FindEffect(request.effect);
    if (effect.Describe().of_instrument) continue;
    if (!effect.DependsOnPoseOnly(request) || !effect.NotTestable(context, request).empty()) {
      effects.left_out.push_back(InstanceName(request));
      continue;
    }
    for (EffectColumn& column : EffectColumns(context, request)) {
      const auto value = request.values.find(column.parameter);
      if (request.held && value != request.values.end()) {
        for (const SlotWeights& weights : column.slots) {
          effects.held.row(weights.slot) += value->second * weights.weight.transpose();
        }
      }
      for (std::size_t own = 0; own < c.effect_columns.size() && !request.held; ++own) {
        if (c.effect_of_column[own] != k || c.effect_columns[own].parameter != column.parameter) {
          continue;
        }
        effects.columns[own] = std::move(column);
        break;
      }
    }
  }
  return effects;
}

}  // namespace

PredictedPoints PointsAt(const Calibration& c,
                         const Eigen::VectorXd& state,
                         const Eigen::MatrixXd& q) {
  const Recording rows = WithRecorded(q, c.recording);
  const EffectsAtPoses effects = EffectsOf(c, rows);
  const EndFrames ends = c.frames.ends({});
  const auto num_parameters = static_cast<Eigen::Index>(c.parameters.size());
  PredictedPoints points;
  points.left_out = effects.left_out;
  points.p_WQ.resize(3, q.rows());
  points.J = Eigen::MatrixXd::Zero(3 * q.rows(), num_parameters);
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    Eigen::VectorXd delta = effects.held.col(row);
    const auto for_each_slot = [&](const auto& act) {
      for (Eigen::Index k = 0; k < num_parameters; ++k) {
        const Parameter& p = c.parameters[static_cast<std::size_t>(k)];
        if (!p.scope.Holds({})) continue;
        if (p.effect_column < 0) {
          act(k, p.slot, 1.0);
          continue;
        }
        const auto column = static_cast<std::size_t>(p.effect_column);
        for (const SlotWeights& weights : effects.columns[column].slots) {
          act(k, weights.slot, weights.weight[row]);
        }
      }
    };
    for_each_slot(
        [&](Eigen::Index k, int slot, double weight) { delta[slot] += weight * state[k]; });
    PoseWithDerivatives pose;
    c.chain.PoseAndDerivatives(q.row(row).transpose(), delta, ends, &pose);
    points.p_WQ.col(row) = pose.p_WQ;
    for_each_slot([&](Eigen::Index k, int slot, double weight) {
      points.J.block<3, 1>(3 * row, k) += weight * pose.J_p.col(slot);
    });
  }
  return points;
}

Eigen::MatrixXd WithoutMotion(const Eigen::Matrix3Xd& points, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd motion(3 * points.cols(), 6);
  const Eigen::Vector3d middle = points.rowwise().mean();
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Eigen::Vector3d arm = points.col(k) - middle;
    motion.block<3, 3>(3 * k, 0).setIdentity();
    motion.block<3, 3>(3 * k, 3) = -Skew(arm);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(motion);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(motion.rows(), qr.rank());
  return columns - Q * (Q.transpose() * columns);
}

bool KnowsNoCommonBase(const ProblemSpec& spec) {
  const bool differences = spec.measurement.kind.pairs && !spec.measurement.anchored;
  return spec.robot.base_per_edge || spec.robot.base_per_run || differences;
}

}  // namespace dhcal
