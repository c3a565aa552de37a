#include "problems/plan/plan_space.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/physics/effect.h"
#include "core/physics/registry.h"
#include "problems/identify.h"
#include "problems/noise.h"
#include "problems/simulate.h"
#include "problems/task/points.h"
#include "problems/task/region.h"
#include "problems/task/task_error.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

constexpr int kPosesInRange = 300;
constexpr std::uint64_t kRangeSeed = 20040602;

/// Effects that a pose alone decides.
void KeepPredictable(ProblemSpec* spec, std::vector<std::string>* notes) {
  std::vector<EffectRequest> kept;
  for (EffectRequest& effect : spec->parameters.effects) {
    if (FindEffect(effect.effect)->DependsOnPoseOnly(effect)) {
      kept.push_back(std::move(effect));
    } else {
      notes->push_back(
          fmt::format("The effect {} depends on more than the pose; the plan is made without it.",
                      InstanceName(effect)));
    }
  }
  spec->parameters.effects = std::move(kept);
}

}  // namespace

ProblemSpec PlanningProblem(const ProblemSpec& spec, std::vector<std::string>* notes) {
  ProblemSpec planning = spec;
  planning.simulate = SimulationSpec();
  planning.robot.base_per_run = planning.robot.tool_per_run = false;
  if (spec.robot.base_per_run || spec.robot.tool_per_run) {
    notes->emplace_back("The plan is for one run, with one base and one tool.");
  }
  KeepPredictable(&planning, notes);
  if (!spec.measurement.kind.pairs || spec.measurement.kind.edges) return planning;
  planning.measurement.kind = KindNamed("position");
  planning.measurement.noise = NoiseKind::kIndependent;
  planning.measurement.anchored = false;
  if (!spec.measurement.anchored) {
    for (const char* const shift : {"base_x", "base_y", "base_z"}) {
      planning.parameters.estimate.emplace_back(shift);
    }
  }
  if (spec.measurement.noise == NoiseKind::kIndependent) {
    notes->emplace_back(
        "Differences of poses are planned as if each pose were read once ('noise: shared_pose').");
  }
  return planning;
}

std::vector<std::string> SharedNames(const Calibration& c) {
  std::vector<std::string> names;
  for (const Parameter& p : c.parameters) {
    const bool shared =
        p.scope.kind == ParameterScope::Kind::kAll || p.scope.kind == ParameterScope::Kind::kTarget;
    if (shared) names.push_back(p.name);
  }
  return names;
}

Eigen::MatrixXd RegionWeights(const Calibration& c,
                              const std::vector<std::string>& names,
                              const TaskError& region) {
  const auto size = static_cast<Eigen::Index>(c.parameters.size());
  const PredictedPoints points = PointsAt(c, Eigen::VectorXd::Zero(size), region.q);
  const Eigen::VectorXd tolerance = ScalesOf(c.parameters).tolerance;
  Eigen::MatrixXd J =
      Eigen::MatrixXd::Zero(points.J.rows(), static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto found = std::find_if(c.parameters.begin(),
                                    c.parameters.end(),
                                    [&](const Parameter& p) { return p.name == names[k]; });
    if (found == c.parameters.end()) continue;
    const auto column = found - c.parameters.begin();
    J.col(static_cast<Eigen::Index>(k)) = points.J.col(column) * tolerance[column];
  }
  if (region.aligned) J = WithoutMotion(points.p_WQ, J);
  return J.transpose() * J / static_cast<double>(points.p_WQ.cols());
}

TaskError PlanRegion(const ProblemSpec& spec) {
  if (spec.task) return TaskPoses(spec);
  TaskError region;
  region.aligned = KnowsNoCommonBase(spec);
  Rng rng(kRangeSeed);
  const JointRange range(spec.robot);
  region.q.resize(kPosesInRange, spec.robot.num_joints());
  for (Eigen::Index row = 0; row < kPosesInRange; ++row) {
    region.q.row(row) = range.Draw(&rng).transpose();
  }
  region.poses = kPosesInRange;
  region.region =
      fmt::format("{} random poses within the joints' limits (no 'task' is given)", kPosesInRange);
  return region;
}

std::optional<Noise> PlanNoise(const ProblemSpec& spec,
                               const Recording* own,
                               double* fit_rms,
                               Diagnostics* diagnostics) {
  *fit_rms = kNotSet;
  const MeasurementSpec& measurement = spec.measurement;
  Noise noise;
  if (own != nullptr) {
    const Result result = IdentifyGeometry(spec, *own, Progress());
    if (result.best() != nullptr) {
      *fit_rms = result.best()->rms_point;
      noise.sigma = result.noise_sigma;
      if (!std::isnan(result.noise_sigma_rotation)) {
        noise.sigma_rotation = result.noise_sigma_rotation;
      }
      return noise;
    }
  }
  if (!measurement.sigma) {
    diagnostics->Error(measurement.where,
                       "a plan needs the noise of the readings, and there is no recording with a "
                       "usable fit to find it from; state 'measurement.sigma_mm'");
    return std::nullopt;
  }
  noise.sigma = *measurement.sigma;
  if (!measurement.kind.sees_orientation()) return noise;
  if (!measurement.sigma_rotation) {
    diagnostics->Error(measurement.where,
                       "a plan needs the noise of the readings; state "
                       "'measurement.sigma_rotation_mrad'");
    return std::nullopt;
  }
  noise.sigma_rotation = *measurement.sigma_rotation;
  return noise;
}

std::optional<Recording> ReadingsAt(const ProblemSpec& planning,
                                    const Recording& rows,
                                    Diagnostics* diagnostics) {
  Rng rng(1);  // without noise nothing is drawn that matters
  return SimulateAt(planning, rows, &rng, diagnostics);
}

}  // namespace dhcal
