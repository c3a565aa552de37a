// A physical effect: a function of a pose's circumstances, added to slots of the chain.
//
//   delta_slot(row) = sum over parameters k of weight_k(row) p_k
//
// An effect is linear in its parameters: what is not (an order, a time constant, an instant) is a
// setting, so that zero parameters are exactly no effect and the derivative at zero is not
// degenerate. The weights depend on the recording and on the robot as the context has it: nominal,
// or as a fit found it. The difference is of second order (a thousandth of the effect).
// Source of the effects and their sizes: core/physics/PHYSICS.md.
#ifndef DHCAL_CORE_PHYSICS_EFFECT_H_
#define DHCAL_CORE_PHYSICS_EFFECT_H_

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/effect_request.h"
#include "core/physics/context.h"

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

/// What the library says about an effect, the same for all robots.
struct EffectDescription {
  std::string name;                                           // "joint_compliance"
  std::string summary;                                        // one sentence in plain words
  std::string formula;                                        // "d theta_j = c tau_j"
  std::string parameters;                                     // "compliance [rad/(N m)]"
  std::vector<std::pair<std::string, std::string>> settings;  // {"order", "N, default 1"}
  std::string needs;    // columns or keys that it needs; empty = joint angles suffice
  std::string typical;  // size, with its source
  bool has_joint = true;
  /// False for what free geometry can always do: a diagnosis says how well it hides, no more.
  bool may_be_named = true;
  /// A free curve of the joint's angle: no candidate of its own, offered where a search finds more
  /// lines at a joint than few gears have.
  bool is_curve = false;
  /// Nobody knows whether what drives it is a cause: beside a rest, which has a cause of its own
  /// that may go along with the driver, it has no name.
  bool needs_whole_model = false;
  /// It belongs to what measures: the robot stands where it would without it.
  bool of_instrument = false;
  /// ... a head over straight edges: where there is none, it is neither tried nor spoken of.
  bool of_head = false;
  /// What drives it counts from a zero that nobody knows: a constant of the slots it moves is no
  /// error of the geometry.
  bool zero_unknown = false;
};

/// Where an effect sits, what drives it, and which others it is easily taken for.
struct EffectPlace {
  std::string effect_class;  // "C1" ... "C10" of PHYSICS.md, or "geometry"
  std::string location;      // "joint 2", "link 2", "base", "tool", "sensor"
  std::string driver;        // "gravity torque"
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
  virtual ~Effect() = default;

  virtual EffectDescription Describe() const = 0;
  /// Why this recording cannot show the effect there; empty when it can.
  virtual std::string NotTestable(const PhysicsContext& context,
                                  const EffectRequest& request) const = 0;
  /// The effect's parameters; only where it is testable.
  virtual std::vector<EffectColumn> Columns(const PhysicsContext& context,
                                            const EffectRequest& request) const = 0;
  /// The instances that a diagnosis tries, settings included: where an effect does not say, one
  /// without joint and settings.
  virtual std::vector<EffectRequest> Candidates(const PhysicsContext& context) const;
  virtual EffectPlace Place(const PhysicsContext& context, const EffectRequest& request) const = 0;
  /// What moves these readings in the same way under another name of its own, and is no candidate
  /// for that reason: who names one has to name all.
  virtual std::vector<EffectRequest> Twins(const PhysicsContext& /*context*/,
                                           const EffectRequest& /*request*/) const {
    return {};
  }
  /// True if the joint angles and the payload alone say what it does: such an effect can be
  /// predicted at poses that were not recorded.
  virtual bool DependsOnPoseOnly(const EffectRequest& /*request*/) const { return false; }
  /// "joint 2 yields 1.13 +- 0.05 urad per N m under gravity".
  virtual std::string Sentence(const PhysicsContext& context,
                               const EffectRequest& request,
                               const std::vector<EffectValue>& values) const = 0;
  virtual WorkedExample Example() const = 0;
};

/// "joint_compliance.2.compliance", "tool_step.x".
std::string ParameterName(const EffectRequest& request, const std::string& parameter);

/// "gear_harmonic at joint 1 (order 2)".
std::string InstanceName(const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_EFFECT_H_
