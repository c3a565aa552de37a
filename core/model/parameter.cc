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
    case ParameterGroup::kEffect:
      return "effect";
  }
  return "?";
}

const char* ToString(Unit unit) {
  switch (unit) {
    case Unit::kRadian:
      return "rad";
    case Unit::kMetre:
      return "m";
    case Unit::kOther:
      return "";
  }
  return "?";
}

}  // namespace dhcal
