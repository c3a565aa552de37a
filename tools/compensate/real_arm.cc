#include "tools/compensate/real_arm.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/calibration.h"

namespace dhcal {
namespace {

// Rows behind the wanted ones, in which every joint moves both ways under several loads: whether an
// effect shows in few or similar poses is no question here.
constexpr int kPadding = 40;
constexpr std::uint64_t kPaddingSeed = 1;
constexpr double kSlideRange = 0.3;  // [m]

/// Approach directions decide, and a row has them: from its columns or the row before.
bool IsBacklashByDirection(const EffectRequest& effect) {
  return effect.effect == "backlash" &&
         (effect.setting("flank", 0) == 0 || effect.setting("friction_Nm", 0) > 0);
}

bool IsPredictable(const EffectRequest& effect) {
  return FindEffect(effect.effect)->DependsOnPoseOnly(effect) || effect.effect == "backlash";
}

Eigen::MatrixXd Below(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
  Eigen::MatrixXd both(top.rows() + bottom.rows(), bottom.cols());
  both << top, bottom;
  return both;
}

}  // namespace

RealArm::RealArm(const ProblemSpec& spec, const Recording& rows, Diagnostics* diagnostics)
    : spec_(spec), rows_(rows), inverse_(spec.robot), effects_(spec.parameters.effects) {
  ProblemSpec rigid = spec;
  rigid.parameters.effects.clear();
  const Calibration frames(rigid, rows);
  for (int row = 0; row < rows.num_rows(); ++row) {
    ends_.push_back(frames.frames.ends(frames.Labels(row)));
  }
  KeepPredictable(diagnostics);
}

void RealArm::KeepPredictable(Diagnostics* diagnostics) {
  std::vector<EffectRequest> kept;
  for (const EffectRequest& effect : effects_) {
    if (!effect.held) {
      diagnostics->Error(effect.where,
                         fmt::format("the effect {} has no 'values'; take the calibrated.yaml of a "
                                     "result",
                                     InstanceName(effect)));
    } else if (FindEffect(effect.effect)->Describe().of_instrument) {
      continue;  // the robot stands where it would without it
    } else if (!IsPredictable(effect)) {
      diagnostics->Warning(
          effect.where,
          fmt::format("the effect {} depends on more than the pose (a clock, a temperature, a "
                      "column of its recording); it is not compensated",
                      InstanceName(effect)));
    } else if (CheckValues(effect, diagnostics)) {
      kept.push_back(effect);
      if (IsBacklashByDirection(effect) && rows_.direction.rows() == 0) {
        diagnostics->Warning(
            {rows_.file},
            fmt::format("no column dir{}: {} takes the sense of the last motion from the row "
                        "before, and none in a run's first row",
                        effect.joint,
                        InstanceName(effect)));
      }
    }
  }
  effects_ = std::move(kept);
}

bool RealArm::CheckValues(const EffectRequest& effect, Diagnostics* diagnostics) const {
  const Recording padded =
      Padded(Eigen::MatrixXd::Zero(rows_.num_rows(), inverse_.chain().num_joints()));
  const PhysicsContext context(spec_.robot, padded, {spec_.robot.X_WB});
  const std::string reason = FindEffect(effect.effect)->NotTestable(context, effect);
  if (!reason.empty()) {
    diagnostics->Error(
        effect.where,
        fmt::format("the effect {} cannot be compensated: {}", InstanceName(effect), reason));
    return false;
  }
  std::vector<std::string> names;
  for (const EffectColumn& column : EffectColumns(context, effect)) {
    names.push_back(column.parameter);
  }
  for (const auto& [name, value] : effect.values) {
    if (std::find(names.begin(), names.end(), name) != names.end() || value == 0) continue;
    diagnostics->Error(effect.where,
                       fmt::format("the effect {} has a value of '{}', which has no meaning here",
                                   InstanceName(effect),
                                   name));
    return false;
  }
  return true;
}

Recording RealArm::Padded(const Eigen::MatrixXd& q) const {
  Rng rng(kPaddingSeed);
  Recording padded;
  Eigen::MatrixXd anywhere(kPadding, q.cols());
  for (Eigen::Index row = 0; row < kPadding; ++row) {
    for (Eigen::Index joint = 0; joint < q.cols(); ++joint) {
      const bool turns =
          spec_.robot.joints[static_cast<std::size_t>(joint)].type == JointType::kRevolute;
      const double range = turns ? kPi : kSlideRange;
      anywhere(row, joint) = rng.Uniform(-range, range);
    }
  }
  padded.q = Below(q, anywhere);
  Eigen::VectorXd none = Eigen::VectorXd::Constant(kPadding, std::nan(""));
  if (rows_.payload.size() > 0) padded.payload = Below(rows_.payload, none);
  if (rows_.direction.rows() > 0) {
    Eigen::MatrixXd ways(kPadding, q.cols());
    for (Eigen::Index row = 0; row < kPadding; ++row) ways.row(row).setConstant(row % 2 ? 1 : -1);
    padded.direction = Below(rows_.direction, ways);
  }
  padded.run_names = rows_.run_names;
  padded.run_idx = rows_.run_idx;
  if (padded.run_idx.empty()) {
    padded.run_names = {"wanted"};
    padded.run_idx.assign(static_cast<std::size_t>(q.rows()), 0);
  }
  padded.run_idx.insert(padded.run_idx.end(), kPadding, static_cast<int>(padded.run_names.size()));
  padded.run_names.emplace_back("padding");
  padded.target_names = rows_.target_names;
  padded.target_idx = rows_.target_idx;
  if (!padded.target_idx.empty()) padded.target_idx.insert(padded.target_idx.end(), kPadding, 0);
  return padded;
}

std::vector<EffectMove> RealArm::Moves(const Eigen::MatrixXd& q,
                                       const Eigen::MatrixXd& deltas) const {
  std::vector<EffectMove> moves;
  if (effects_.empty()) return moves;
  const Recording padded = Padded(q);
  Eigen::MatrixXd arm = Eigen::MatrixXd::Zero(deltas.rows(), padded.num_rows());
  arm.leftCols(deltas.cols()) = deltas;
  std::vector<Eigen::Isometry3d> bases(padded.run_names.size(), spec_.robot.X_WB);
  for (int row = 0; row < rows_.num_rows(); ++row) {
    bases[static_cast<std::size_t>(padded.run(row))] = ends(row).X_WB;
  }
  const PhysicsContext context(spec_.robot, padded, bases, arm);
  for (const EffectRequest& effect : effects_) {
    for (EffectColumn& column : EffectColumns(context, effect)) {
      const auto value = effect.values.find(column.parameter);
      EffectMove move{ParameterName(effect, column.parameter),
                      value == effect.values.end() ? 0.0 : value->second,
                      std::move(column.slots)};
      for (SlotWeights& weights : move.slots) {
        weights.weight.conservativeResize(rows_.num_rows());
      }
      moves.push_back(std::move(move));
    }
  }
  return moves;
}

Eigen::MatrixXd RealArm::Deltas(const Eigen::MatrixXd& q) const {
  Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(chain().slots().size(), rows_.num_rows());
  for (int turn = 0; turn < kBends && !effects_.empty(); ++turn) {
    Eigen::MatrixXd bent = Eigen::MatrixXd::Zero(deltas.rows(), deltas.cols());
    for (const EffectMove& move : Moves(q, deltas)) {
      for (const SlotWeights& weights : move.slots) {
        bent.row(weights.slot) += move.value * weights.weight.transpose();
      }
    }
    deltas = std::move(bent);
  }
  return deltas;
}

Eigen::Isometry3d RealArm::Pose(const Eigen::MatrixXd& q,
                                const Eigen::MatrixXd& deltas,
                                int row_idx) const {
  return chain().Pose<double>(q.row(row_idx).transpose(), deltas.col(row_idx), ends(row_idx));
}

}  // namespace dhcal
