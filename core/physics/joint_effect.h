// An effect of one joint: what such effects have in common.
#ifndef DHCAL_CORE_PHYSICS_JOINT_EFFECT_H_
#define DHCAL_CORE_PHYSICS_JOINT_EFFECT_H_

#include <string>
#include <vector>

#include "core/physics/columns.h"
#include "core/physics/effect.h"

namespace dhcal {

/// What the joint must do, or be, for the effect to show.
enum class JointNeeds { kNothing, kMotion, kTurningMotion };

struct JointEffectTraits {
  EffectClass effect_class = EffectClass::kGeometry;
  DriverKind driver = DriverKind::kConstant;  // of the joint itself
  JointNeeds needs = JointNeeds::kNothing;
  bool tries_sliding = false;  // a diagnosis tries it at prismatic joints, too
};

/// What the traits do not say, an effect overrides.
class JointEffect : public Effect {
 public:
  JointEffect(EffectDescription description, JointEffectTraits traits);

  std::string NotTestable(const PhysicsContext& context, const EffectRequest& request) const final;
  std::vector<EffectRequest> Candidates(const PhysicsContext& context) const override;
  EffectPlace Place(const PhysicsContext& context, const EffectRequest& request) const override;

 protected:
  /// Why a joint that exists cannot show it, beside the traits' reasons; "" when it can.
  virtual std::string NotTestableAt(const PhysicsContext& /*context*/,
                                    const EffectRequest& /*request*/) const {
    return "";
  }
  /// One request per joint that a diagnosis tries, without settings.
  std::vector<EffectRequest> EveryJoint(const PhysicsContext& context) const;

 private:
  JointEffectTraits traits_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_JOINT_EFFECT_H_
