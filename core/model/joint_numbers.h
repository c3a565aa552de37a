// The five numbers of a Denavit-Hartenberg row, in one table: whoever names, reads, writes,
// perturbs or judges them goes through it.
#ifndef DHCAL_CORE_MODEL_JOINT_NUMBERS_H_
#define DHCAL_CORE_MODEL_JOINT_NUMBERS_H_

#include <array>
#include <cstddef>
#include <optional>

#include "core/base/units.h"
#include "core/model/parameter.h"
#include "core/model/robot.h"

namespace dhcal {

/// Position of a number among its joint's slots (core/NOTATION.md).
enum class JointSlot { kTheta = 0, kD = 1, kA = 2, kAlpha = 3, kBeta = 4 };

struct JointNumber {
  JointSlot slot = JointSlot::kTheta;
  ParameterGroup group = ParameterGroup::kTheta;
  const char* name = "";  // "theta": as in files, parameters and reports
  Unit unit = Unit::kRadian;
  double JointRow::*value = nullptr;
  /// What manufacture or mastering leaves open, one sigma [rad or m].
  double tolerance = 0;
};

constexpr std::size_t kNumJointNumbers = 5;

/// In the paper's order, which is that of parameters.
inline constexpr std::array<JointNumber, kNumJointNumbers> kJointNumbers = {
    JointNumber{JointSlot::kTheta,
                ParameterGroup::kTheta,
                "theta",
                Unit::kRadian,
                &JointRow::theta,
                3 * kMilliradian},  // mastering
    JointNumber{JointSlot::kAlpha,
                ParameterGroup::kAlpha,
                "alpha",
                Unit::kRadian,
                &JointRow::alpha,
                1 * kMilliradian},  // machining of a casting
    JointNumber{
        JointSlot::kA, ParameterGroup::kA, "a", Unit::kMetre, &JointRow::a, 0.5 * kMillimetre},
    JointNumber{
        JointSlot::kD, ParameterGroup::kD, "d", Unit::kMetre, &JointRow::d, 0.5 * kMillimetre},
    JointNumber{JointSlot::kBeta,
                ParameterGroup::kBeta,
                "beta",
                Unit::kRadian,
                &JointRow::beta,
                1 * kMilliradian}};

constexpr const JointNumber& NumberOf(JointSlot slot) {
  std::size_t k = 0;
  while (kJointNumbers[k].slot != slot) ++k;
  return kJointNumbers[k];
}

/// Null for groups that are no numbers of a row (frames, effects).
constexpr const JointNumber* NumberOf(ParameterGroup group) {
  for (const JointNumber& number : kJointNumbers) {
    if (number.group == group) return &number;
  }
  return nullptr;
}

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_JOINT_NUMBERS_H_
