// The comparison of two results as a document.
#ifndef DHCAL_TOOLS_COMPARE_COMPARISON_REPORT_H_
#define DHCAL_TOOLS_COMPARE_COMPARISON_REPORT_H_

#include "core/report/document.h"
#include "tools/compare/read_result.h"

namespace dhcal {

/// Which is better on unseen rows, what moved and by how many sigmas, which effects either has.
Document ComparisonReport(const ReadResult& a, const ReadResult& b);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPARE_COMPARISON_REPORT_H_
