#include "core/model/parameter.h"

namespace dhcal {

const char* ToString(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::kTheta:
      return "theta";
    case ParameterGroup::kAlpha:
      return "alpha";
    case ParameterGroup::kA:
      return "a";
    case ParameterGroup::kD:
      return "d";
    case ParameterGroup::kBeta:
      return "beta";
    case ParameterGroup::kBase:
      return "base";
    case ParameterGroup::kTool:
      return "tool";
  }
  return "?";
}

const char* ToString(Unit unit) { return unit == Unit::kRadian ? "rad" : "m"; }

}  // namespace dhcal
