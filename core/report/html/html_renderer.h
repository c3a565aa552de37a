// A report as one page for a browser: no network, no script, plots and their data inside. The short
// answer stands first, on a sheet of its own where it is printed.
#ifndef DHCAL_CORE_REPORT_HTML_HTML_RENDERER_H_
#define DHCAL_CORE_REPORT_HTML_HTML_RENDERER_H_

#include <string>

#include "core/report/document.h"

namespace dhcal {

/// Where plots cannot be drawn, the page says why and holds the rest.
std::string ToHtml(const Document& document);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_HTML_RENDERER_H_
