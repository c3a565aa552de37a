// The report of a run of the program, and the forms in which it is written.
#ifndef DHCAL_CORE_REPORT_REPORT_H_
#define DHCAL_CORE_REPORT_REPORT_H_

#include <string>
#include <vector>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "core/report/document.h"

namespace dhcal {

/// What was asked, what was found, what can be trusted, what cannot and why.
/// Figures of an empty `recording` are left out.
Document ReportOf(const ProblemSpec& spec, const Recording& recording, const Result& result);

/// A document without sections, of the same title.
Document EmptyReport(const Result& result);

/// A file of the result folder that holds the report.
struct ReportFormat {
  const char* file;  // "report.txt"
  std::string (*render)(const Document& document);
};

/// All of them. A further one is its renderer and a line here.
const std::vector<ReportFormat>& ReportFormats();

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_REPORT_H_
