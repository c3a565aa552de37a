#include "core/model/parameter.h"

#include "core/model/joint_numbers.h"

namespace dhcal {

const char* ToString(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::kTheta:
    case ParameterGroup::kAlpha:
    case ParameterGroup::kA:
    case ParameterGroup::kD:
    case ParameterGroup::kBeta:
      return NumberOf(group)->name;
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
