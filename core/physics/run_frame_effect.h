// A frame that differs between the runs of a recording although the problem file has one for all.
#ifndef DHCAL_CORE_PHYSICS_RUN_FRAME_EFFECT_H_
#define DHCAL_CORE_PHYSICS_RUN_FRAME_EFFECT_H_

#include <string>
#include <vector>

#include "core/physics/effect.h"

namespace dhcal {

class RunFrameEffect final : public Effect {
 public:
  /// `frame`: "base" or "tool".
  RunFrameEffect(std::string name, std::string frame);

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
  bool is_base() const { return frame_ == "base"; }

  std::string name_, frame_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_RUN_FRAME_EFFECT_H_
