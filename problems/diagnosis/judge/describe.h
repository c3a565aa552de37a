// The members of a joint fit in words and numbers.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DESCRIBE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DESCRIBE_H_

#include <string>
#include <vector>

#include "core/model/diagnosis.h"
#include "problems/diagnosis/judge/certainty.h"
#include "problems/diagnosis/judge/unseen_rows.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/refit/joint_model.h"

namespace dhcal {

/// Positions of the members without a name.
std::vector<int> CellMembers(const std::vector<Member>& members);

/// Members (positions, ascending) that make one finding each: the same effect, or lines and a curve
/// of one joint's own angle. Cells and effects of the problem file make none.
std::vector<std::vector<int>> FindingGroups(const std::vector<Member>& members);

/// The finding of each group, in their order. `certainties`: of the outcome's fit.
std::vector<Finding> DescribeMembers(const JointModel& model,
                                     const LoopOutcome& outcome,
                                     const Certainties& certainties,
                                     const UnseenRows& unseen,
                                     const std::vector<std::vector<int>>& groups);

std::vector<Finding> DescribeCompletions(const JointModel& model,
                                         const LoopOutcome& outcome,
                                         const Certainties& certainties);

/// The named members with their values: what a fit of other rows can hold.
std::vector<EffectRequest> ModelOf(const LoopOutcome& outcome, const Certainties& certainties);

/// What an item that competes with a finding is called.
EffectRequest NameOf(const Item& item);

/// Geometric unknowns that the physics moved by more than their uncertainty, largest first.
std::vector<MovedParameter> MovedByPhysics(const JointModel& model,
                                           const LoopOutcome& outcome,
                                           const Certainties& certainties,
                                           const Eigen::VectorXd& before);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_DESCRIBE_H_
