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

/// What frames and parameters may differ by between rows.
struct RowLabels {
  int run = 0;     // of the recording's
  int target = 0;  // of the robot's
  int edge = 0;    // of the recording's
};

/// The rows that a parameter acts on: all, or those of one run, of one target or of one edge.
struct ParameterScope {
  enum class Kind { kAll, kRun, kTarget, kEdge };

  Kind kind = Kind::kAll;
  int index = 0;  // of the recording's runs or edges, or of the robot's targets

  bool Holds(const RowLabels& row) const {
    switch (kind) {
      case Kind::kAll:
        return true;
      case Kind::kRun:
        return index == row.run;
      case Kind::kTarget:
        return index == row.target;
      case Kind::kEdge:
        return index == row.edge;
    }
    return false;
  }
  /// Labels of rows that it acts on.
  RowLabels row() const {
    return {kind == Kind::kRun ? index : 0,
            kind == Kind::kTarget ? index : 0,
            kind == Kind::kEdge ? index : 0};
  }
};

/// One unknown. A geometric freedom is a constant added to one slot of the chain
/// (core/kinematics/slots.h), for all rows or only for those of one run, target or edge. A
/// parameter of a physical effect (core/physics/effect.h) adds to slots by its weights of each row.
struct Parameter {
  std::string name;  // "theta1", "base_rx", "tool_z.A" (target, run or edge after the dot)
  ParameterGroup group = ParameterGroup::kTheta;
  Unit unit = Unit::kRadian;
  int slot = -1;
  ParameterScope scope;
  int effect_column = -1;             // >= 0: an effect's; index into the calibration's columns
  std::string unit_text;              // of an effect's parameter, SI
  double tolerance = 0;               // what manufacture or set-up leaves open, one sigma, SI
  std::optional<double> prior_sigma;  // SI
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_PARAMETER_H_
