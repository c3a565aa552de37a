// A plot in the words of gnuplot.
#ifndef DHCAL_CORE_REPORT_HTML_PLOT_SCRIPT_H_
#define DHCAL_CORE_REPORT_HTML_PLOT_SCRIPT_H_

#include <string>

#include "core/report/document.h"

namespace dhcal {

/// Colours that a plot is drawn in. A drawing names them by number; which they are is for the page
/// to say, in light and in dark.
enum class Ink {
  kText = 10,
  kGrid,
  kFrame,
  kLevel,
  kOwn = 20,  // the first of kOwnInks
  kBefore = 30,
  kAfter,
  kMuted,
  kShade = 40,  // the first of Plot::kShades
};
constexpr int kOwnInks = 6;

/// Red and green of a colour that stands for an ink; its blue is the ink's number.
constexpr int kInkRed = 1, kInkGreen = 2;

/// Commands that draw the plot as one SVG to standard output.
std::string GnuplotScript(const Plot& plot);

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_PLOT_SCRIPT_H_
