// A run of dhcal_plan that splits the alternatives of an ambiguous verdict.
#ifndef DHCAL_TOOLS_PLAN_SPLIT_RUN_H_
#define DHCAL_TOOLS_PLAN_SPLIT_RUN_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/report/document.h"
#include "problems/plan/split.h"

namespace dhcal {

/// The alternatives that a result.json lists; nothing, with an error added, where it has no
/// diagnosis.
std::optional<std::vector<Alternative>> ReadAlternatives(const std::string& result_json,
                                                         Diagnostics* diagnostics);

/// The same by a diagnosis made now.
std::vector<Alternative> DiagnosedAlternatives(const ProblemSpec& spec, const Recording& own);

/// Pairs before and after. `out`: the file of the poses.
Document SplitReport(const ProblemSpec& spec, const SplitPlan& plan, const std::string& out);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PLAN_SPLIT_RUN_H_
