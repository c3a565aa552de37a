#include "core/physics/frame_effect.h"

#include <utility>

#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"

namespace dhcal {
FrameEffect::FrameEffect(std::string name, std::string frame, std::string summary)
    : name_(std::move(name)), frame_(std::move(frame)), summary_(std::move(summary)) {}

EffectDescription FrameEffect::Describe() const {
  EffectDescription d{name_,
                      summary_ + " (geometry, not physics)",
                      fmt::format("{0}_xyz += (x, y, z), {0}_rxyz += (rx, ry, rz)", frame_),
                      "x, y, z [m], rx, ry, rz [rad]",
                      {},
                      "",
                      "0.1-10 mm [PHYSICS.md X1]"};
  d.has_joint = false;
  return d;
}

std::string FrameEffect::NotTestable(const PhysicsContext& /*context*/,
                                     const EffectRequest& /*request*/) const {
  return "";
}

std::vector<EffectColumn> FrameEffect::Columns(const PhysicsContext& context,
                                               const EffectRequest& /*request*/) const {
  const SlotLayout& slots = context.slots();
  return FrameColumns(frame_ == "base" ? slots.base(0) : slots.tool(0),
                      SlotLayout::kPerFrame,
                      1e-3,
                      Eigen::VectorXd::Ones(context.num_rows()));
}

std::vector<EffectRequest> FrameEffect::Candidates(const PhysicsContext& /*context*/) const {
  return {};
}

EffectPlace FrameEffect::Place(const PhysicsContext& /*context*/,
                               const EffectRequest& /*request*/) const {
  return {"geometry", frame_, "constant"};
}

std::string FrameEffect::Sentence(const PhysicsContext& /*context*/,
                                  const EffectRequest& /*request*/,
                                  const std::vector<EffectValue>& values) const {
  std::string text = summary_ + ":";
  for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
    const EffectValue value = Find(values, SlotLayout::ComponentName(k));
    if (!(value.sigma > 0)) continue;
    text += fmt::format(
        " {} {},", SlotLayout::ComponentName(k), Quantity(value, 1e-3, k < 3 ? "mm" : "mrad"));
  }
  text.pop_back();
  return text;
}

WorkedExample FrameEffect::Example() const {
  WorkedExample example;
  example.request.effect = name_;
  example.request.values["z"] = 2e-3;
  example.row = 1;
  example.slot = frame_ + "_z";
  example.expected = 2e-3;
  return example;
}

}  // namespace dhcal
