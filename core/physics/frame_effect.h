// A frame that the problem file holds fixed, as a completion of the geometry: six constants.
#ifndef DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_
#define DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

class FrameEffect final : public Effect {
 public:
  /// `frame`: "base" or "tool"; `summary`: what it means when the constants are not zero.
  FrameEffect(std::string name, std::string frame, std::string summary);

  EffectDescription Describe() const override;
  std::string NotTestable(const PhysicsContext& context,
                          const EffectRequest& request) const override;
  std::vector<EffectColumn> Columns(const PhysicsContext& context,
                                    const EffectRequest& request) const override;
  std::vector<EffectRequest> Candidates(const PhysicsContext& context) const override;
  EffectPlace Place(const PhysicsContext& context, const EffectRequest& request) const override;
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override;
  WorkedExample Example() const override;

 private:
  std::string name_, frame_, summary_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_FRAME_EFFECT_H_
