// A frame that the problem file holds fixed, as a completion of the geometry: six constants.
#ifndef DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_
#define DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

class FrameEffect final : public Effect {
 public:
  /// `frame`: kBase or kTool; `summary`: what it means when the constants are not zero.
  FrameEffect(const std::string& name, ParameterGroup frame, const std::string& summary);

  std::string NotTestable(const PhysicsContext& context,
                          const EffectRequest& request) const override;
  std::vector<EffectColumn> Columns(const PhysicsContext& context,
                                    const EffectRequest& request) const override;
  std::vector<EffectRequest> Candidates(const PhysicsContext& context) const override;
  EffectPlace Place(const PhysicsContext& context, const EffectRequest& request) const override;
  std::string Sentence(const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override;
  WorkedExample Example() const override;

 private:
  ParameterGroup frame_;
  std::string summary_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_
