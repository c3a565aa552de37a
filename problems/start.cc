#include "problems/start.h"

#include <algorithm>
#include <vector>

#include <Eigen/SVD>

#include "problems/edge_start.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

/// The rotation nearest to a 3 x 3 matrix.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// All six parameters of the group are free for rows with these labels, and none has a prior.
bool IsFree(const Calibration& c, ParameterGroup group, const RowLabels& labels) {
  const auto free = [&](const Parameter& p) {
    return p.group == group && p.scope.Holds(labels) && !p.prior_sigma;
  };
  return std::count_if(c.parameters.begin(), c.parameters.end(), free) == SlotLayout::kPerFrame;
}

Eigen::Matrix3Xd Columns(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    columns.col(static_cast<Eigen::Index>(k)) = points[k];
  }
  return columns;
}

/// X_BQ of a row with the tool as it stands.
Eigen::Isometry3d PoseInBase(const Calibration& c, int row_idx) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(c.chain.slots().size());
  return c.chain.FlangePose(c.recording.q.row(row_idx).transpose(), zero) *
         c.frames.tool(c.Labels(row_idx));
}

void AlignBase(int run, Calibration* c) {
  const bool differences = c->measurement->kind().pairs;
  std::vector<Eigen::Vector3d> in_base, in_world;
  for (const Reading& reading : c->readings.fitted) {
    if (c->frames.base_per_run() && c->recording.run(reading.row_idx) != run) continue;
    Eigen::Vector3d p_BQ = PoseInBase(*c, reading.row_idx).translation();
    if (differences) {
      // An anchored first pose is no difference.
      if (reading.previous_idx < 0) continue;
      p_BQ -= PoseInBase(*c, reading.previous_idx).translation();
    }
    in_base.push_back(p_BQ);
    in_world.push_back(c->measurement->Point(reading));
  }
  if (in_base.empty()) return;
  if (differences) {
    c->frames.mutable_base({run}).linear() = AlignVectors(Columns(in_base), Columns(in_world));
  } else {
    c->frames.mutable_base({run}) = AlignPoints(Columns(in_base), Columns(in_world));
  }
}

void AlignToolRotation(int run, int target, Calibration* c) {
  std::vector<Eigen::Matrix3d> rotations;
  for (const Reading& reading : c->readings.fitted) {
    const RowLabels labels = c->Labels(reading.row_idx);
    if (c->frames.tool_per_run() && labels.run != run) continue;
    if (!c->spec.robot.targets.empty() && labels.target != target) continue;
    const Eigen::Isometry3d X_WT =
        c->frames.base(labels) * PoseInBase(*c, reading.row_idx) * c->frames.tool(labels).inverse();
    rotations.push_back(X_WT.linear().transpose() * c->measurement->Orientation(reading));
  }
  if (!rotations.empty()) c->frames.mutable_tool({run, target}).linear() = MeanRotation(rotations);
}

void AlignFrames(Calibration* c) {
  if (c->measurement->kind().edges) return AlignEdges(c);
  if (!c->measurement->kind().is_point()) return;
  const int num_runs = std::max<int>(static_cast<int>(c->recording.run_names.size()), 1);
  const int num_targets = std::max<int>(static_cast<int>(c->spec.robot.targets.size()), 1);
  for (int run = 0; run < (c->frames.base_per_run() ? num_runs : 1); ++run) {
    if (IsFree(*c, ParameterGroup::kBase, {run})) AlignBase(run, c);
  }
  if (!c->measurement->kind().sees_orientation()) return;
  for (int run = 0; run < (c->frames.tool_per_run() ? num_runs : 1); ++run) {
    for (int target = 0; target < num_targets; ++target) {
      if (IsFree(*c, ParameterGroup::kTool, {run, target})) AlignToolRotation(run, target, c);
    }
  }
}

}  // namespace

Eigen::Matrix3d AlignVectors(const Eigen::Matrix3Xd& v_B, const Eigen::Matrix3Xd& v_W) {
  return NearestRotation(v_W * v_B.transpose());
}

Eigen::Isometry3d AlignPoints(const Eigen::Matrix3Xd& p_B, const Eigen::Matrix3Xd& p_W) {
  const Eigen::Vector3d mean_B = p_B.rowwise().mean(), mean_W = p_W.rowwise().mean();
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = AlignVectors(p_B.colwise() - mean_B, p_W.colwise() - mean_W);
  X_WB.translation() = mean_W - X_WB.linear() * mean_B;
  return X_WB;
}

Eigen::Matrix3d MeanRotation(const std::vector<Eigen::Matrix3d>& rotations) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& R : rotations) sum += R;
  return NearestRotation(sum);
}

void AlignStart(Calibration* c) {
  AlignFrames(c);
  c->UpdateEffects();
}

std::optional<ResidualStatistics> FitFramesAlone(Calibration* c, const Progress& progress) {
  Calibration frames_only = *c;
  auto& unknowns = frames_only.parameters;
  unknowns.erase(std::remove_if(unknowns.begin(),
                                unknowns.end(),
                                [](const Parameter& p) {
                                  return p.group != ParameterGroup::kBase &&
                                         p.group != ParameterGroup::kTool;
                                }),
                 unknowns.end());
  if (unknowns.empty()) return std::nullopt;
  FitSettings settings = SettingsOf(frames_only, progress);
  settings.solver.truncation = Truncation();
  const Fit fit = RunFit(frames_only, settings);
  if (!fit.summary.IsSolutionUsable()) return std::nullopt;
  const ResidualStatistics left =
      Statistics(frames_only, fit.summary.state, frames_only.readings.fitted);
  // A prior holds a parameter to the file's value: moving the start would move the prior.
  const bool has_prior = std::any_of(unknowns.begin(), unknowns.end(), [](const Parameter& p) {
    return p.prior_sigma.has_value();
  });
  if (!has_prior) {
    c->frames.Apply(unknowns, fit.summary.state, c->chain.slots());
    c->UpdateEffects();
  }
  return left;
}

Frames AlignedFrames(const ProblemSpec& spec, const Recording& recording) {
  ProblemSpec rigid = spec;
  rigid.parameters.effects.clear();
  Calibration c(rigid, recording);
  AlignStart(&c);
  FitFramesAlone(&c, {});
  return c.frames;
}

}  // namespace dhcal
