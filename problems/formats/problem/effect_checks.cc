#include "problems/formats/problem/effect_checks.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/physics/registry.h"

namespace dhcal {

namespace {

using ColumnList = std::vector<EffectColumn>;

/// "x, y, z"; of a long list the first ones.
std::string ListedNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format(
      "{}, ... ({} in all)", fmt::join(names.begin(), names.begin() + kMost, ", "), names.size());
}

/// Parameters that the effect may have. Of a free curve those of the whole turn: a value that was
/// found on one recording says nothing of another one that does not go there, and is no mistake.
std::vector<std::string> ParametersOf(const PhysicsContext& context,
                                      const EffectRequest& request,
                                      const ColumnList& columns) {
  std::vector<std::string> names;
  const auto add = [&](const ColumnList& more) {
    for (const EffectColumn& column : more) names.push_back(column.parameter);
  };
  if (!FindEffect(request.effect)->Describe().is_curve) {
    add(columns);
    return names;
  }
  constexpr int kQuarterDegrees = 1441;
  Recording turn;
  turn.q = Eigen::VectorXd::LinSpaced(kQuarterDegrees, -kPi, kPi)
               .replicate(1, static_cast<Eigen::Index>(context.num_joints()));
  const PhysicsContext everywhere(context.robot(), turn, {Eigen::Isometry3d::Identity()});
  add(EffectColumns(everywhere, request));
  return names;
}

/// True if both move the same by the same amounts: one effect, once with a setting written out and
/// once with its default.
bool MoveTheSame(const ColumnList& a, const ColumnList& b) {
  const auto same_slot = [](const SlotWeights& x, const SlotWeights& y) {
    return x.slot == y.slot && x.weight == y.weight;
  };
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [&](const EffectColumn& x, const EffectColumn& y) {
        return std::equal(
            x.slots.begin(), x.slots.end(), y.slots.begin(), y.slots.end(), same_slot);
      });
}

void CheckHeldValues(const PhysicsContext& context,
                     const EffectRequest& request,
                     const ColumnList& columns,
                     Diagnostics* diagnostics) {
  const std::vector<std::string> names = ParametersOf(context, request, columns);
  for (const auto& [name, value] : request.values) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string nearest = NearestName(name, names);
    diagnostics->Error(
        request.where,
        fmt::format("the effect {} cannot be held at its values: it has no parameter '{}'{}; its "
                    "parameters are {}",
                    InstanceName(request),
                    Printable(name),
                    nearest.empty() ? "" : " (did you mean '" + nearest + "'?)",
                    ListedNames(names)));
  }
}

}  // namespace

void CheckEffectsFit(const ProblemSpec& spec,
                     const Recording& recording,
                     Diagnostics* diagnostics) {
  const std::vector<EffectRequest>& effects = spec.parameters.effects;
  if (effects.empty() || recording.num_rows() == 0) return;
  const PhysicsContext context(spec.robot, recording, {spec.robot.X_WB});
  std::vector<ColumnList> columns(effects.size());  // none where it cannot be shown
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const EffectRequest& request = effects[k];
    const std::string reason = FindEffect(request.effect)->NotTestable(context, request);
    if (!reason.empty()) {
      diagnostics->Error(request.where,
                         fmt::format("the effect {} cannot be estimated from this recording: {}",
                                     InstanceName(request),
                                     reason));
      continue;
    }
    columns[k] = EffectColumns(context, request);
    if (request.held) CheckHeldValues(context, request, columns[k], diagnostics);
    for (std::size_t before = 0; before < k; ++before) {
      const EffectRequest& first = effects[before];
      if (first.effect != request.effect || first.joint != request.joint) continue;
      if (!MoveTheSame(columns[before], columns[k])) continue;
      diagnostics->Error(request.where,
                         fmt::format("the effect {} asks for the same effect a second time, first "
                                     "in line {} as {}; keep one of them",
                                     InstanceName(request),
                                     first.where.line,
                                     InstanceName(first)));
      break;
    }
  }
}

}  // namespace dhcal
