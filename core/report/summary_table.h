// Several problems in one table.
#ifndef DHCAL_CORE_REPORT_SUMMARY_TABLE_H_
#define DHCAL_CORE_REPORT_SUMMARY_TABLE_H_

#include <string>
#include <vector>

#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

struct SummaryRow {
  std::string problem;
  std::string status;              // "ok", "diverged", "input error", ...
  const Result* result = nullptr;  // null when there is none
};

/// One row per problem.
Table SummaryTable(const std::vector<SummaryRow>& rows);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_SUMMARY_TABLE_H_
