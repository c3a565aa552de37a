#include "core/physics/joint_effect.h"

#include <utility>

#include <fmt/format.h>

namespace dhcal {
namespace {

EffectDescription WithJoint(EffectDescription description) {
  description.has_joint = true;
  return description;
}

}  // namespace

JointEffect::JointEffect(EffectDescription description, JointEffectTraits traits)
    : Effect(WithJoint(std::move(description))), traits_(traits) {}

std::string JointEffect::NotTestable(const PhysicsContext& c, const EffectRequest& request) const {
  if (request.joint < 1 || request.joint > c.num_joints()) {
    return fmt::format("needs a joint from 1 to {}", c.num_joints());
  }
  const int joint = JointIndex(request);
  const bool turns = c.revolute(joint);
  if (traits_.needs == JointNeeds::kTurningMotion && !turns) return "the joint is prismatic";
  if (std::string why = NotTestableAt(c, request); !why.empty()) return why;
  const bool needs_motion = traits_.needs != JointNeeds::kNothing;
  return needs_motion && !c.moves(joint) ? "the joint does not move" : "";
}

std::vector<EffectRequest> JointEffect::EveryJoint(const PhysicsContext& c) const {
  std::vector<EffectRequest> requests;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (traits_.tries_sliding || c.revolute(joint)) requests.push_back(Request(joint + 1));
  }
  return requests;
}

std::vector<EffectRequest> JointEffect::Candidates(const PhysicsContext& c) const {
  return EveryJoint(c);
}

EffectPlace JointEffect::Place(const PhysicsContext& /*c*/, const EffectRequest& request) const {
  return {traits_.effect_class, JointName(request.joint), {traits_.driver, request.joint}};
}

}  // namespace dhcal
