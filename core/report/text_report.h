// The report as plain text, at most 100 columns wide.
#ifndef DHCAL_CORE_REPORT_TEXT_REPORT_H_
#define DHCAL_CORE_REPORT_TEXT_REPORT_H_

#include <string>
#include <vector>

#include "core/model/problem_spec.h"
#include "core/model/result.h"

namespace dhcal {

/// report.txt: what was asked, what was found, what can be trusted, what cannot and why.
std::string TextReport(const ProblemSpec& spec, const Result& result);

/// One line per problem, for several problems in one call.
struct SummaryRow {
  std::string problem;
  std::string status;              // "ok", "diverged", "input error", ...
  const Result* result = nullptr;  // null when there is none
};
std::string SummaryTable(const std::vector<SummaryRow>& rows);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_TEXT_REPORT_H_
