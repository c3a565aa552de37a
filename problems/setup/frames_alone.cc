#include "problems/setup/frames_alone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "problems/calibration.h"
#include "problems/prediction.h"
#include "problems/start.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

constexpr int kMostTrims = 4;
constexpr double kMostTrimmed = 0.2;  // of the rows
constexpr double kFarOff = 5;         // times the median: no noise, no physics, no table's error

/// Of all rows with the frames as they stand.
Eigen::Matrix3Xd ModelPoints(const Calibration& c) {
  Eigen::Matrix3Xd points(3, c.recording.num_rows());
  const Eigen::VectorXd zero =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.parameters.size()));
  for (int row = 0; row < c.recording.num_rows(); ++row) {
    points.col(row) = c.Pose(zero, row).translation();
  }
  return points;
}

FramesAlone FitOnce(const ProblemSpec& frames_only, const Recording& recording) {
  FramesAlone result;
  result.rms = std::numeric_limits<double>::infinity();
  Calibration c(frames_only, recording);
  if (c.readings.fitted.empty()) return result;
  AlignStart(&c);
  const std::optional<ResidualStatistics> left = FitFramesAlone(&c, {});
  if (!left) return result;
  const double rms = std::isnan(left->rms_point) ? left->rms : left->rms_point;
  if (std::isfinite(rms)) result.rms = rms;
  result.frames = c.frames;
  result.points = ModelPoints(c);
  return result;
}

/// Sets aside the rows whose points are far off beside the others', a fifth of all at most. False
/// where they are those that are set aside already.
bool TrimFarOff(const std::vector<bool>& always,
                const Eigen::Matrix3Xd& points,
                Recording* recording) {
  if (recording->p_WQ.rows() == 0) return false;
  const auto n = static_cast<std::size_t>(recording->num_rows());
  std::vector<double> off(n, 0), sorted;
  for (std::size_t row = 0; row < n; ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    const bool used = (always.empty() || !always[row]) && recording->p_WQ.row(at).allFinite();
    if (!used) continue;
    off[row] = (recording->p_WQ.row(at).transpose() - points.col(at)).norm();
    sorted.push_back(off[row]);
  }
  if (sorted.empty()) return false;
  std::sort(sorted.begin(), sorted.end());
  const double limit = std::max(kFarOff * sorted[sorted.size() / 2],
                                sorted[static_cast<std::size_t>(
                                    (1 - kMostTrimmed) * static_cast<double>(sorted.size() - 1))]);
  std::vector<bool> aside(n, false);
  for (std::size_t row = 0; row < n; ++row) {
    aside[row] = off[row] > limit || (!always.empty() && always[row]);
  }
  if (aside == recording->set_aside) return false;
  recording->set_aside = aside;
  return true;
}

}  // namespace

ProblemSpec FramesOnly(const ProblemSpec& spec, const Recording& recording) {
  ProblemSpec frames = spec;
  frames.parameters.estimate = {"base", "tool"};
  frames.parameters.fix.clear();
  frames.parameters.prior_sigma.clear();
  auto& effects = frames.parameters.effects;
  effects.erase(
      std::remove_if(
          effects.begin(), effects.end(), [](const EffectRequest& effect) { return !effect.held; }),
      effects.end());
  frames.solver.loss = LossKind::kNone;
  frames.measurement.noise = NoiseKind::kIndependent;
  if (recording.p_WQ.rows() > 0 && frames.measurement.kind.is_point()) {
    frames.measurement.kind = KindNamed("position");
  }
  return frames;
}

FramesAlone FitFrames(const ProblemSpec& spec, const Recording& recording) {
  const ProblemSpec frames_only = FramesOnly(spec, recording);
  Recording all = recording;
  all.is_test.clear();
  if (all.set_aside.empty()) all.set_aside.assign(static_cast<std::size_t>(all.num_rows()), false);
  FramesAlone result = FitOnce(frames_only, all);
  for (int round = 0; round < kMostTrims && result.frames; ++round) {
    if (!TrimFarOff(recording.set_aside, result.points, &all)) break;
    result = FitOnce(frames_only, all);
  }
  return result;
}

}  // namespace dhcal
