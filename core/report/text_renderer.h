// A report as plain text, at most kReportWidth columns wide. Figures cannot be drawn and are passed
// over: what a reader must know of them stands in words and tables.
#ifndef DHCAL_CORE_REPORT_TEXT_RENDERER_H_
#define DHCAL_CORE_REPORT_TEXT_RENDERER_H_

#include <string>

#include "core/report/document.h"

namespace dhcal {

std::string ToText(const Document& document);

/// With an empty line before its heading; "" when the section has nothing to say.
std::string ToText(const Section& section);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_TEXT_RENDERER_H_
