#include "problems/calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <glog/logging.h>

#include "core/physics/registry.h"
#include "problems/parameter_set.h"
#include "problems/without_rows.h"
#include "residuals/readings.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

/// Sums what columns with given values add, per slot. Names without a column were refused on input
/// (CheckEffectsFit), but for parts of a curve where this recording does not go.
void AddHeld(const std::vector<EffectColumn>& columns,
             const std::map<std::string, double>& values,
             std::vector<SlotWeights>* held) {
  for (const EffectColumn& column : columns) {
    const auto value = values.find(column.parameter);
    if (value == values.end()) continue;
    for (const SlotWeights& weights : column.slots) {
      const auto same = std::find_if(held->begin(), held->end(), [&](const SlotWeights& sum) {
        return sum.slot == weights.slot;
      });
      if (same == held->end()) {
        held->push_back({weights.slot, value->second * weights.weight});
      } else {
        same->weight += value->second * weights.weight;
      }
    }
  }
}

}  // namespace

Calibration::Calibration(const ProblemSpec& problem_spec, const Recording& rows)
    : spec(problem_spec),
      recording(rows),
      measurement(MakeMeasurement(problem_spec.measurement, rows)),
      chain(problem_spec.robot),
      parameters(ResolveParameters(problem_spec, rows).estimated),
      readings(CollectReadings(*measurement, rows, problem_spec.measurement.anchored)),
      frames(problem_spec.robot, rows) {
  if (!problem_spec.parameters.effects.empty()) SetEffects(problem_spec.parameters.effects);
  if (!rows.set_aside.empty()) SetAside();
}

std::vector<Eigen::Isometry3d> Calibration::BasesAt(const Eigen::VectorXd& state) const {
  Frames moved = frames;
  if (state.size() > 0) moved.Apply(parameters, state, chain.slots());
  return moved.bases();
}

PhysicsContext Calibration::Context() const {
  if (arm.size() > 0) return PhysicsContext(spec.robot, recording, arm_bases, arm);
  return PhysicsContext(spec.robot, recording, BasesAt({}));
}

void Calibration::Bend(const Eigen::VectorXd& state) {
  Eigen::MatrixXd bent(chain.slots().size(), recording.num_rows());
  for (int row = 0; row < recording.num_rows(); ++row) bent.col(row) = SlotDeltas(state, row);
  arm = std::move(bent);
  arm_bases = BasesAt(state);
  UpdateEffects();
}

void Calibration::SetAside() {
  std::set<int> off;
  for (std::size_t row = 0; row < recording.set_aside.size(); ++row) {
    if (recording.set_aside[row]) off.insert(static_cast<int>(row));
  }
  for (std::vector<Reading>* const readings_of : {&readings.fitted, &readings.test}) {
    for (const Reading& reading : *readings_of) {
      if (off.count(reading.row_idx) > 0) readings.set_aside.push_back(reading);
    }
    *readings_of = WithoutRows(*this, *readings_of, off);
  }
}

void Calibration::SetEffects(const std::vector<EffectRequest>& requests) {
  parameters.erase(std::remove_if(parameters.begin(),
                                  parameters.end(),
                                  [](const Parameter& p) { return p.effect_column >= 0; }),
                   parameters.end());
  effect_columns.clear();
  effect_of_column.clear();
  held.clear();
  effects = requests;
  if (requests.empty()) return;
  const PhysicsContext context = Context();
  for (const EffectRequest& request : requests) {
    if (request.held) {
      AddHeld(EffectColumns(context, request), request.values, &held);
      continue;
    }
    for (EffectColumn& column : EffectColumns(context, request)) {
      parameters.push_back(
          EffectParameter(request, column, static_cast<int>(effect_columns.size())));
      effect_columns.push_back(std::move(column));
      effect_of_column.push_back(static_cast<std::size_t>(&request - requests.data()));
    }
  }
}

int Calibration::Target(int row_idx) const {
  const auto& targets = spec.robot.targets;
  if (targets.empty() || recording.target_idx.empty()) return 0;
  const std::string& name =
      recording.target_names[static_cast<std::size_t>(recording.target(row_idx))];
  const auto found = std::find_if(
      targets.begin(), targets.end(), [&](const auto& target) { return target.name == name; });
  CHECK(found != targets.end()) << "target " << name << " was not checked on input";
  return static_cast<int>(found - targets.begin());
}

RowLabels Calibration::Labels(int row_idx) const {
  // A row without an edge gives no reading along one: any will do.
  return {recording.run(row_idx), Target(row_idx), std::max(recording.edge(row_idx), 0)};
}

Eigen::VectorXd Calibration::SlotDeltas(const Eigen::VectorXd& state, int row_idx) const {
  const RowLabels labels = Labels(row_idx);
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(chain.slots().size());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!parameters[k].scope.Holds(labels)) continue;
    const double value = state[static_cast<Eigen::Index>(k)];
    if (parameters[k].effect_column < 0) {
      delta[parameters[k].slot] += value;
      continue;
    }
    const auto column = static_cast<std::size_t>(parameters[k].effect_column);
    for (const SlotWeights& weights : effect_columns[column].slots) {
      delta[weights.slot] += weights.weight[row_idx] * value;
    }
  }
  for (const SlotWeights& amount : held) delta[amount.slot] += amount.weight[row_idx];
  return delta;
}

double Calibration::RowSigma(int row_idx, const Noise& noise) const {
  return HasOwnSigma(row_idx) ? recording.sigma[row_idx] : noise.sigma;
}

bool Calibration::HasOwnSigma(int row_idx) const {
  return recording.sigma.size() > 0 && std::isfinite(recording.sigma[row_idx]);
}

Eigen::Isometry3d Calibration::Pose(const Eigen::VectorXd& state, int row_idx) const {
  return chain.Pose<double>(recording.q.row(row_idx).transpose(),
                            SlotDeltas(state, row_idx),
                            frames.ends(Labels(row_idx)));
}

}  // namespace dhcal
