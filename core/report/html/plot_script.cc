#include "core/report/html/plot_script.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/text_layout.h"

namespace dhcal {
namespace {

constexpr int kPlotWidth = 480;       // [px]
constexpr int kPlotHeight = 320;      // [px]
constexpr int kSquareHeight = 400;    // [px] of plots with one scale
constexpr int kRowHeight = 19;        // [px] per name, of plots that lie
constexpr int kHeightBeside = 95;     // [px] title, key and axis of plots that lie
constexpr int kMostOfName = 34;       // [characters]
constexpr int kMostOfKey = 44;        // [characters]
constexpr double kInterval95 = 1.96;  // [sigma]

/// A gnuplot string. Its text is not looked at further: single quotes, and the terminal is told not
/// to.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') {
      quoted += ' ';
    } else {
      quoted += c == '\'' ? "''" : std::string(1, c);
    }
  }
  return quoted + "'";
}

std::string InkColour(int ink) {
  return fmt::format("rgb '#{:02x}{:02x}{:02x}'", kInkRed, kInkGreen, ink);
}
std::string InkColour(Ink ink) { return InkColour(static_cast<int>(ink)); }

/// The colour of a series, the `own_idx`-th of those without a tone.
std::string ColourOf(const Plot::Series& series, int own_idx) {
  if (series.mark == Plot::Mark::kCells) {
    return InkColour(static_cast<int>(Ink::kShade) + series.shade - 1);
  }
  switch (series.tone) {
    case Plot::Tone::kBefore:
      return InkColour(Ink::kBefore);
    case Plot::Tone::kAfter:
      return InkColour(Ink::kAfter);
    case Plot::Tone::kMuted:
      return InkColour(Ink::kMuted);
    case Plot::Tone::kOwn:
      break;
  }
  return InkColour(static_cast<int>(Ink::kOwn) + own_idx % kOwnInks);
}

std::string AxisLabel(const Plot::Axis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

/// `name` is gnuplot's: x, y or y2; `down`: the first name stands at the top.
std::string AxisCommands(const char* name, const Plot::Axis& axis, bool down) {
  std::string text = fmt::format(
      "set {}label {} textcolor {}\n", name, Quoted(AxisLabel(axis)), InkColour(Ink::kText));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  if (axis.names.empty()) return text;
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < axis.names.size(); ++i) {
    tics.push_back(fmt::format("{} {}", Quoted(Clip(axis.names[i], kMostOfName)), i));
  }
  const double first = -0.6, last = static_cast<double>(axis.names.size()) - 0.4;
  text += fmt::format("set {}tics ({}) scale 0\n", name, fmt::join(tics, ", "));
  return text +
         fmt::format("set {}range [{}:{}]\n", name, down ? last : first, down ? first : last);
}

/// 1, 2 or 5 times a power of ten, such that `range` has about four of it.
double TicDistance(double range) {
  constexpr double kIntervals = 4;
  const double wanted = range / kIntervals;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / power;
  return power * (digit > 5 ? 10 : digit > 2 ? 5 : digit > 1 ? 2 : 1);
}

/// Smallest and largest number of all series along x or y.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double width() const { return high - low; }
};

Span SpanOf(const Plot& plot, std::vector<double> Plot::Series::*values) {
  Span span;
  for (const Plot::Series& series : plot.series) {
    const bool spread = values == &Plot::Series::y && !series.sigma.empty();
    for (std::size_t i = 0; i < (series.*values).size(); ++i) {
      const double more = spread ? kInterval95 * series.sigma[i] : 0;
      span.Add((series.*values)[i] - more);
      span.Add((series.*values)[i] + more);
    }
    if (series.mark == Plot::Mark::kBars && values == &Plot::Series::y) span.Add(0);
  }
  return span;
}

std::string TicCommand(const char* name, const Plot::Axis& axis, const Span& span) {
  if (axis.logarithmic || !axis.names.empty() || !(span.width() > 0)) return "";
  return fmt::format("set {}tics {:.7g}\n", name, TicDistance(span.width()));
}

/// Gnuplot itself lets the numbers of a short axis run into each other.
std::string TicsOfShortAxes(const Plot& plot) {
  if (plot.lying) return TicCommand("x", plot.y, SpanOf(plot, &Plot::Series::y));
  std::string text = TicCommand("x", plot.x, SpanOf(plot, &Plot::Series::x));
  if (plot.same_scale) text += TicCommand("y", plot.y, SpanOf(plot, &Plot::Series::y));
  return text;
}

int HeightOf(const Plot& plot) {
  if (plot.same_scale) return kSquareHeight;
  if (!plot.lying) return kPlotHeight;
  return kHeightBeside +
         kRowHeight * static_cast<int>(std::max<std::size_t>(plot.x.names.size(), 4));
}

bool HasKey(const Plot& plot) {
  const auto named = [](const auto& one) { return !one.name.empty(); };
  return std::any_of(plot.series.begin(), plot.series.end(), named) ||
         (!plot.lying && std::any_of(plot.levels.begin(), plot.levels.end(), named));
}

std::string FrameCommands(const Plot& plot) {
  const std::string text_ink = InkColour(Ink::kText), frame = InkColour(Ink::kFrame);
  std::string text = fmt::format(
      "reset\nset encoding utf8\n"
      "set terminal svg size {},{} dynamic noenhanced font 'sans-serif,12' linewidth 1\n"
      "set border {} linecolor {}\n"
      "set tics nomirror out scale 0.5 textcolor {}\n"
      "set grid linecolor {} linetype 1 linewidth 1\n"
      "set format '%g'\nset pointintervalbox 0\nset style fill solid\n"
      "set bars 0.5\n",
      kPlotWidth,
      HeightOf(plot),
      plot.y_right ? 11 : 3,  // left and bottom, and right
      frame,
      text_ink,
      InkColour(Ink::kGrid));
  if (!plot.title.empty()) {
    text += fmt::format("set title {} textcolor {}\n", Quoted(plot.title), text_ink);
  }
  text += HasKey(plot) ? fmt::format(
                             "set key above left horizontal Left reverse samplen 1.5 "
                             "textcolor {}\n",
                             text_ink)
                       : "unset key\n";
  if (plot.same_scale) text += "set size ratio -1\n";
  text += AxisCommands(plot.lying ? "y" : "x", plot.x, plot.lying);
  text += AxisCommands(plot.lying ? "x" : "y", plot.y, false);
  text += TicsOfShortAxes(plot);
  if (plot.y_right) text += "set y2tics\n" + AxisCommands("y2", *plot.y_right, false);
  return text;
}

/// Columns of a series' data: x y, sigma if there, dx dy of arrows.
std::string DataBlock(const Plot::Series& series, std::size_t idx) {
  std::string text = fmt::format("$s{} << E\n", idx);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    text += fmt::format("{:.7g} {:.7g}", series.x[i], series.y[i]);
    if (!series.sigma.empty()) text += fmt::format(" {:.7g}", kInterval95 * series.sigma[i]);
    if (series.mark == Plot::Mark::kArrows) {
      text += fmt::format(" {:.7g} {:.7g}", series.dx[i], series.dy[i]);
    }
    text += '\n';
  }
  return text + "E\n";
}

/// "'name'" of a plot's element in the key.
std::string TitleWords(const std::string& name) {
  return name.empty() ? "notitle" : "title " + Quoted(Clip(name, kMostOfKey));
}

std::string WithPoints(const Plot& plot, const std::string& data, bool bars, const char* size) {
  const std::string xy = plot.lying ? "2:1" : "1:2";
  return bars ? fmt::format("{} using {}:3 with {}errorbars pointtype 7 pointsize {}",
                            data,
                            xy,
                            plot.lying ? "x" : "y",
                            size)
              : fmt::format("{} using {} with points pointtype 7 pointsize {}", data, xy, size);
}

/// The elements of `plot` that draw one series.
std::vector<std::string> Elements(const Plot& plot, std::size_t idx, const std::string& colour) {
  using Mark = Plot::Mark;
  const Plot::Series& series = plot.series[idx];
  const std::string data = fmt::format("$s{}", idx);
  const std::string ends = fmt::format(" linecolor {} ", colour);
  const std::string key = TitleWords(series.name);
  const bool bars = !series.sigma.empty();
  switch (series.mark) {
    case Mark::kLine:
      return {
          WithPoints(plot, data, bars, "0.4") + ends + key,
          fmt::format("{} using {} with lines{}notitle", data, plot.lying ? "2:1" : "1:2", ends)};
    case Mark::kCurve:
      return {fmt::format("{} using 1:2{} with lines linewidth 1.6{}{}",
                          data,
                          series.on_right ? " axes x1y2" : "",
                          ends,
                          key)};
    case Mark::kPoints:
      return {WithPoints(plot, data, bars, bars ? "0.45" : "0.3") + ends + key};
    case Mark::kSteps:
      return {
          data + " using 1:2 with fillsteps fillstyle transparent solid 0.3 noborder" + ends + key,
          data + " using 1:2 with steps linewidth 1.4" + ends + "notitle"};
    case Mark::kArrows:
      return {data + " using 1:2:3:4 with vectors head filled size screen 0.014,22 linewidth 1.2" +
              ends + key};
    case Mark::kCells:
      return {data +
              " using 1:2:($1-0.48):($1+0.48):($2-0.46):($2+0.46) with boxxyerror "
              "fillstyle solid noborder" +
              ends + key};
    case Mark::kBars:
      return {data +
              (plot.lying ? " using (0.5*$2):1:(0):2:($1-0.36):($1+0.36)"
                          : " using 1:(0.5*$2):($1-0.36):($1+0.36):(0):2") +
              " with boxxyerror fillstyle solid noborder" + ends + key};
  }
  return {};
}

std::vector<std::string> LevelElements(const Plot& plot) {
  std::vector<std::string> elements;
  if (plot.lying) return elements;
  for (const Plot::Level& level : plot.levels) {
    elements.push_back(fmt::format("{:.7g} with lines dashtype 2 linewidth 1.4 linecolor {} {}",
                                   level.y,
                                   InkColour(Ink::kLevel),
                                   TitleWords(level.name)));
  }
  return elements;
}

}  // namespace

std::string GnuplotScript(const Plot& plot) {
  std::string text = FrameCommands(plot);
  if (plot.lying) {
    for (const Plot::Level& level : plot.levels) {
      text += fmt::format(
          "set arrow from {0:.7g}, graph 0 to {0:.7g}, graph 1 nohead dashtype 2 "
          "linecolor {1}\n",
          level.y,
          InkColour(Ink::kLevel));
    }
  }
  std::vector<std::string> elements;
  int own = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    text += DataBlock(plot.series[i], i);
    const std::string colour = ColourOf(plot.series[i], own);
    if (plot.series[i].tone == Plot::Tone::kOwn) ++own;
    for (const std::string& element : Elements(plot, i, colour)) elements.push_back(element);
  }
  for (const std::string& element : LevelElements(plot)) elements.push_back(element);
  return text + fmt::format("plot {}\n", fmt::join(elements, ", "));
}

}  // namespace dhcal
