// What these rows cannot show: effects that are not testable, and those that may be there unseen.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_HIDDEN_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_HIDDEN_H_

#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/physics/context.h"
#include "problems/diagnosis/hypotheses/bank.h"
#include "problems/diagnosis/refit/joint_model.h"
#include "problems/diagnosis/search/gram.h"

namespace dhcal {

/// Lists what cannot be tested, and why.
void AddNotTestable(const ProblemSpec& spec, const PhysicsContext& context, DiagnosisResult* d);

/// What was not found, and what it could do elsewhere. `rest`: of the rows of `fit`.
void AddHiddenRisks(const JointModel& model,
                    const JointRows& fit,
                    const EvidenceRule& rule,
                    const Bank::Rest& rest,
                    DiagnosisResult* d);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_HIDDEN_H_
