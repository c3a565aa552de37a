// Plots as drawings to stand in a page, made by gnuplot.
#ifndef DHCAL_CORE_REPORT_HTML_PLOT_SVG_H_
#define DHCAL_CORE_REPORT_HTML_PLOT_SVG_H_

#include <string>
#include <vector>

#include "core/report/document.h"

namespace dhcal {

struct DrawnPlots {
  std::vector<std::string> svg;  // one per plot; empty where nothing could be drawn
  std::string why_not;           // a sentence that says what to do; empty where all are drawn
};

/// All of them by one process. The colours are CSS variables: --ink-10, the number an Ink.
DrawnPlots DrawPlots(const std::vector<Plot>& plots);

/// What gnuplot printed, as an element of a page: without head and names of its own, colours as
/// variables, identifiers with `prefix` before them.
std::string AsPageElement(const std::string& svg, const std::string& prefix);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_PLOT_SVG_H_
