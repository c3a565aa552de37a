#include "problems/diagnosis/judge/doubtful.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "core/physics/registry.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

/// Of an effect that a joint's own angle drives: the joint, from 1; else 0.
int JointOfOwnAngle(const Item& item, const PhysicsContext& context) {
  if (item.kind != ItemKind::kEffect || item.request.joint == 0) return 0;
  const EffectPlace place = FindEffect(item.request.effect)->Place(context, item.request);
  return place.driver == "joint angle" ? item.request.joint : 0;
}

bool IsAt(const Item& cell, int joint, const PhysicsContext& context) {
  if (cell.kind != ItemKind::kCell) return false;
  return cell.slot == context.slots().Name(context.joint_slot(joint - 1)) ||
         std::find(cell.driven_by.begin(), cell.driven_by.end(), joint) != cell.driven_by.end();
}

/// A gear's flank that a joint's load decides.
bool IsLoadedFlank(const Item& item) {
  return item.kind == ItemKind::kEffect && item.request.setting("flank", 0) != 0;
}

/// True if a joint that yields to a load has a flank by the same load, too: with a load that is not
/// quite known the sign is no more than a correction of its shape.
bool CorrectsAShape(const std::vector<Member>& members, std::size_t m) {
  if (!IsLoadedFlank(members[m].item)) return false;
  return std::any_of(members.begin(), members.end(), [&](const Member& other) {
    return other.item.elastic && !IsLoadedFlank(other.item) &&
           other.item.request.joint == members[m].item.request.joint;
  });
}

}  // namespace

std::vector<int> DoubtfulMembers(const JointRows& fit) {
  const auto& members = fit.state.members;
  const auto moved = [&](std::size_t m) -> Eigen::VectorXd {
    return fit.X.middleCols(fit.FirstColumn(m), members[m].item.size) * members[m].value;
  };
  std::map<int, Eigen::VectorXd> named, unnamed;  // of each joint: what moves the rows
  const auto add = [&](int joint, const Eigen::VectorXd& rows, std::map<int, Eigen::VectorXd>* to) {
    const auto at = to->try_emplace(joint, Eigen::VectorXd::Zero(rows.size())).first;
    at->second += rows;
  };
  for (std::size_t m = 0; m < members.size(); ++m) {
    const int joint = JointOfOwnAngle(members[m].item, *fit.context);
    if (joint > 0 && !members[m].given) add(joint, moved(m), &named);
    for (int at = 1; at <= fit.context->num_joints(); ++at) {
      if (IsAt(members[m].item, at, *fit.context)) add(at, moved(m), &unnamed);
    }
  }
  std::vector<int> doubtful;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const int joint = JointOfOwnAngle(members[m].item, *fit.context);
    if (members[m].given) continue;
    const bool shadow = joint > 0 && unnamed.count(joint) > 0 &&
                        unnamed[joint].norm() >= kTuning.shadow * named[joint].norm();
    if (shadow || CorrectsAShape(members, m)) doubtful.push_back(static_cast<int>(m));
  }
  return doubtful;
}

Item Unnamed(const Item& item, const PhysicsContext& context) {
  const int joint = item.request.joint;
  Item cell = item;
  cell.kind = ItemKind::kCell;
  cell.cell = std::make_shared<const SlotColumns>(ColumnsOf(item, context));
  cell.slot = context.slots().Name(context.joint_slot(joint - 1));
  if (JointOfOwnAngle(item, context) > 0) {
    cell.driver = fmt::format("q{}", joint);
    cell.driven_by = {joint};
    cell.driver_values = context.q(joint - 1);
  } else {
    cell.driver = FindEffect(item.request.effect)->Place(context, item.request).driver;
  }
  cell.id = fmt::format("{} x {} ({})", cell.slot, cell.driver, item.id);
  cell.request = EffectRequest();
  return cell;
}

}  // namespace dhcal
