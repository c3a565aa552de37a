// The unknowns of a calibration, by name.
#ifndef DHCAL_CORE_MODEL_PARAMETER_H_
#define DHCAL_CORE_MODEL_PARAMETER_H_

#include <optional>
#include <string>

namespace dhcal {

enum class ParameterGroup { kTheta, kAlpha, kA, kD, kBeta, kBase, kTool, kEffect };

/// Group name as in a problem file: "theta", "alpha", "a", "d", "beta", "base", "tool"; "effect".
const char* ToString(ParameterGroup group);

/// kOther: a parameter of a physical effect, which names its own unit.
enum class Unit { kRadian, kMetre, kOther };

/// "rad" or "m"; "" for kOther.
const char* ToString(Unit unit);

/// One unknown. A geometric freedom is a constant added to one slot of the chain
/// (core/kinematics/slots.h), for all rows or only for the rows of one run or target. A parameter
/// of a physical effect (core/physics/effect.h) adds to slots by its weights of each row.
struct Parameter {
  std::string name;  // "theta1", "base_rx", "tool_z.A" (target or run after the dot)
  ParameterGroup group = ParameterGroup::kTheta;
  Unit unit = Unit::kRadian;
  int slot = -1;
  int run = -1;                       // >= 0: only rows of this run
  int target = -1;                    // >= 0: only rows of this target
  int effect_column = -1;             // >= 0: an effect's; index into the calibration's columns
  std::string unit_text;              // of an effect's parameter, SI
  double tolerance = 0;               // what manufacture or set-up leaves open, one sigma, SI
  std::optional<double> prior_sigma;  // SI
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_PARAMETER_H_
