#include "core/physics/frame_effect.h"

#include <string>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"

namespace dhcal {
namespace {

EffectDescription About(const std::string& name, ParameterGroup frame, const std::string& summary) {
  EffectDescription d{
      name,
      summary + " (geometry, not physics)",
      fmt::format("{0}_xyz += (x, y, z), {0}_rxyz += (rx, ry, rz)", ToString(frame)),
      "x, y, z [m], rx, ry, rz [rad]",
      {},
      "",
      "0.1-10 mm [physics.md X1]"};
  d.completes = frame;
  return d;
}

}  // namespace

FrameEffect::FrameEffect(const std::string& name, ParameterGroup frame, const std::string& summary)
    : Effect(About(name, frame, summary)), frame_(frame), summary_(summary) {
  CHECK(frame == ParameterGroup::kBase || frame == ParameterGroup::kTool);
}

std::string FrameEffect::NotTestable(const PhysicsContext& /*context*/,
                                     const EffectRequest& /*request*/) const {
  return "";
}

std::vector<EffectColumn> FrameEffect::Columns(const PhysicsContext& context,
                                               const EffectRequest& /*request*/) const {
  std::vector<EffectColumn> columns;
  for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
    const int slot =
        frame_ == ParameterGroup::kBase ? context.slots().base(k) : context.slots().tool(k);
    columns.push_back(SlotColumn(SlotLayout::ComponentName(k),
                                 k < 3 ? "m" : "rad",
                                 1e-3,
                                 slot,
                                 Eigen::VectorXd::Ones(context.num_rows())));
  }
  return columns;
}

std::vector<EffectRequest> FrameEffect::Candidates(const PhysicsContext& /*context*/) const {
  return {};
}

EffectPlace FrameEffect::Place(const PhysicsContext& /*context*/,
                               const EffectRequest& /*request*/) const {
  return {EffectClass::kGeometry, ToString(frame_), {DriverKind::kConstant}};
}

std::string FrameEffect::Sentence(const EffectRequest& /*request*/,
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
  return {WithValue(Request(), "z", 2e-3), 1, std::string(ToString(frame_)) + "_z", 2e-3};
}

}  // namespace dhcal
