// A physical effect: a function of a pose's circumstances, added to slots of the chain.
//
//   delta_slot(row) = sum over parameters k of weight_k(row) p_k
//
// An effect is linear in its parameters: what is not (an order, a time constant, an instant) is a
// setting, so that zero parameters are exactly no effect and the derivative at zero is not
// degenerate. The weights depend on the recording and on the nominal robot only; the difference to
// weights at the calibrated robot is of second order (a thousandth of the effect).
// Source of the effects and their sizes: shared physics.md, part A.
#ifndef DHCAL_CORE_PHYSICS_EFFECT_H_
#define DHCAL_CORE_PHYSICS_EFFECT_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/effect_request.h"
#include "core/model/parameter.h"
#include "core/physics/context.h"
#include "core/physics/driver.h"
#include "core/physics/effect_class.h"
#include "core/physics/setting.h"

namespace dhcal {

/// What one parameter adds to one slot, per row of the recording.
struct SlotWeights {
  int slot = -1;
  Eigen::VectorXd weight;  // num_rows; [rad or m] per unit of the parameter
};

/// One parameter of an effect and all that it moves.
struct EffectColumn {
  std::string parameter;  // "compliance"
  std::string unit;       // SI, "rad/(N m)"
  double typical = 1;     // size at which one would look for it, SI
  bool positive = false;  // a negative value is an alarm, not physics
  /// Spread of a coefficient of a free curve, SI: with as many of them, only a prior keeps those
  /// that the rows do not determine from running away. 0 = none.
  double prior_sigma = 0;
  std::vector<SlotWeights> slots;
};

/// How often one joint may have an effect at once.
enum class PerJoint {
  kOne,         // settings are alternatives
  kOfEachKind,  // once with each choice of settings
  kManyLines    // lines of a spectrum that can be told apart
};

/// What the library says about an effect, the same for all robots. Nothing but this tells the rest
/// of the program one effect from another: no other file knows an effect by its name.
struct EffectDescription {
  std::string name;        // as problem files write it: "some_effect"
  std::string summary;     // one sentence in plain words
  std::string formula;     // "d theta_j = c tau_j"
  std::string parameters;  // "compliance [rad/(N m)]"
  std::vector<EffectSetting> settings;
  std::string needs;       // columns or keys that it needs; empty = joint angles suffice
  std::string typical;     // size, with its source
  bool has_joint = false;  // a JointEffect
  /// False for what free geometry can always do: a diagnosis says how well it hides, no more.
  bool may_be_named = true;
  /// A free curve of the joint's angle: no candidate of its own, offered where a search finds more
  /// lines at a joint than few gears have.
  bool is_curve = false;
  PerJoint per_joint = PerJoint::kOne;
  /// The group of geometric parameters that it stands for where a problem file leaves them out;
  /// nothing for physics.
  std::optional<ParameterGroup> completes = std::nullopt;
};

/// Where an effect sits, what drives it, and which others it is easily taken for.
struct EffectPlace {
  EffectClass effect_class = EffectClass::kGeometry;
  std::string location;  // "joint 2", "link 2", "base", "tool", "sensor"
  Driver driver;
};

/// A parameter as estimated.
struct EffectValue {
  std::string parameter;
  std::string unit;
  double value = 0;
  double sigma = 0;
};

/// A number that can be checked by hand, for the conformance test and as documentation.
struct WorkedExample {
  EffectRequest request;  // with values
  int row = 0;            // of WorkedExampleRecording() (core/physics/worked_example.h)
  std::string slot;       // "theta2"
  double expected = 0;    // [rad] or [m] added to that slot
};

class Effect {
 public:
  explicit Effect(EffectDescription description) : description_(std::move(description)) {}
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;
  virtual ~Effect() = default;

  const EffectDescription& Describe() const { return description_; }
  const std::string& name() const { return description_.name; }
  /// A request of this effect without settings; `joint` from 1, 0 where it has none.
  EffectRequest Request(int joint = 0) const;
  /// Its setting of this name; null when it has none.
  const EffectSetting* FindSetting(const std::string& setting) const;

  /// Why this recording cannot show the effect there; empty when it can.
  virtual std::string NotTestable(const PhysicsContext& context,
                                  const EffectRequest& request) const = 0;
  /// The effect's parameters; only where it is testable.
  virtual std::vector<EffectColumn> Columns(const PhysicsContext& context,
                                            const EffectRequest& request) const = 0;
  /// Ways in which the first column's shape may be wrong (masses known to 30 %, say), as columns
  /// of one standard deviation per unit of the first parameter. Empty = the shape is sure.
  virtual std::vector<EffectColumn> ShapeErrors(const PhysicsContext& /*context*/,
                                                const EffectRequest& /*request*/) const {
    return {};
  }
  /// The same effect without the numbers that its shape rests on (masses): more parameters, for a
  /// fit that the stated numbers do not bring down to the noise. Nothing where there is no such.
  virtual std::optional<EffectRequest> WithFreeShape(const PhysicsContext& /*context*/,
                                                     const EffectRequest& /*request*/) const {
    return std::nullopt;
  }
  /// The instances that a diagnosis tries, settings included; here the effect itself.
  virtual std::vector<EffectRequest> Candidates(const PhysicsContext& context) const;
  virtual EffectPlace Place(const PhysicsContext& context, const EffectRequest& request) const = 0;
  /// True if the joint angles and the payload alone say what it does: such an effect can be
  /// predicted at poses that were not recorded.
  virtual bool DependsOnPoseOnly(const EffectRequest& /*request*/) const { return false; }
  /// "joint 2 yields 1.13 +- 0.05 urad per N m under gravity".
  virtual std::string Sentence(const EffectRequest& request,
                               const std::vector<EffectValue>& values) const = 0;
  virtual WorkedExample Example() const = 0;
  /// How often per turn of its joint a request repeats; 1 for what does not repeat.
  virtual double Order(const EffectRequest& /*request*/) const { return 1; }

 private:
  EffectDescription description_;
};

EffectRequest WithSetting(EffectRequest request, const std::string& setting, double value);
EffectRequest WithValue(EffectRequest request, const std::string& parameter, double value);

/// "some_effect.2.compliance", "other_effect.x".
std::string ParameterName(const EffectRequest& request, const std::string& parameter);

/// "some_effect at joint 1 (order 2)".
std::string InstanceName(const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_EFFECT_H_
