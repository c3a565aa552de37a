// A plan in words and tables.
#ifndef DHCAL_TOOLS_PLAN_WORDS_H_
#define DHCAL_TOOLS_PLAN_WORDS_H_

#include <string>

#include "core/model/problem_spec.h"
#include "core/report/document.h"
#include "problems/plan/plan.h"

namespace dhcal {

/// What the plan is for, its table, and what follows from it. `out`: the file of its poses.
Document PlanReport(const ProblemSpec& spec, const Plan& plan, const std::string& out);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PLAN_WORDS_H_
