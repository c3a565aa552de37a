// Names that something unnamed at the same joint makes doubtful.
//
// What a joint's angle does to the joint itself looks like the mean of whatever else the angle does
// together with another circumstance: a cable pulled by two joints, a windup that grows with the
// angle. Where such a thing is in the model without a name, the part that has one is its shadow.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DOUBTFUL_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DOUBTFUL_H_

#include <vector>

#include "core/physics/context.h"
#include "problems/diagnosis/hypotheses/item.h"
#include "problems/diagnosis/refit/joint_model.h"

namespace dhcal {

/// Members (positions, ascending) driven by their own joint's angle, where the unnamed members at
/// that joint's angle, or driven by it, move the readings at least `kTuning.shadow` times as far;
/// and a gear's flank by the load of a joint that yields to it, too.
std::vector<int> DoubtfulMembers(const JointRows& fit);

/// The same columns without the name.
Item Unnamed(const Item& item, const PhysicsContext& context);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DOUBTFUL_H_
