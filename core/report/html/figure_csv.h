// The numbers of a figure as a table.
#ifndef DHCAL_CORE_REPORT_HTML_FIGURE_CSV_H_
#define DHCAL_CORE_REPORT_HTML_FIGURE_CSV_H_

#include <string>

#include "core/report/document.h"

namespace dhcal {

/// Comment lines that say what each plot shows, in which units; then one row per point: the plot's
/// number, series, x, y, and names, sigma, dx, dy where some series has them.
std::string FigureCsv(const Figure& figure);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_FIGURE_CSV_H_
