// How each solver ended, step by step.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

constexpr std::size_t kFirstSteps = 12;  // of a long trace
constexpr std::size_t kLastSteps = 4;

std::string Ending(const FitResult& fit) {
  if (fit.termination == Termination::kNotRun) return "not run";
  if (!fit.usable) return "no usable result";
  return fit.converged ? "converged" : "not converged, but usable";
}

std::string Brief(const FitResult& fit) {
  std::string text = Ending(fit);
  if (fit.iterations >= 0) text += ", " + Counted(fit.iterations, "iteration");
  if (fit.rank >= 0) text += fmt::format(", rank {} of {}", fit.rank, fit.columns);
  if (!std::isnan(fit.cost)) text += fmt::format(", cost {:.4e}", fit.cost);
  if (!std::isnan(fit.seconds)) text += fmt::format(", {:.3g} s", fit.seconds);
  return text;
}

std::vector<std::string> StepRow(const IterationRecord& record) {
  return {record.iteration < 0 ? "-" : std::to_string(record.iteration),
          Scientific(record.cost, 4),
          Scientific(record.kappa_norm, 4),
          record.rank < 0 ? "-" : std::to_string(record.rank),
          Scientific(record.step_norm, 3)};
}

Table TraceTable(const FitResult& fit) {
  Table table;
  table.title = "Iterations of " + SolverName(fit.solver);
  table.columns = {{"iteration", ""},
                   {"cost", ""},
                   {"||J drho - dx||", "m"},
                   {"rank", ""},
                   {"step", "tolerances"}};
  const bool is_long = fit.trace.size() > kFirstSteps + kLastSteps + 1;
  for (std::size_t i = 0; i < fit.trace.size(); ++i) {
    if (is_long && i == kFirstSteps) {
      const std::size_t left_out = fit.trace.size() - kFirstSteps - kLastSteps;
      table.AddLeftOut(left_out);
      i += left_out;
    }
    table.AddRow(StepRow(fit.trace[i]));
  }
  return table;
}

/// One quantity of all iterations, a series per solver. Iterations in which it is not known, or
/// zero, have no point on a logarithmic axis.
Plot TracePlot(const Result& result, double IterationRecord::*quantity, const Plot::Axis& axis) {
  Plot plot;
  plot.x = {"iteration", ""};
  plot.y = axis;
  for (const FitResult& fit : result.fits) {
    Plot::Series series;
    series.name = SolverName(fit.solver);
    for (const IterationRecord& record : fit.trace) {
      const double value = record.*quantity;
      if (!std::isfinite(value) || value <= 0) continue;
      series.x.push_back(record.iteration);
      series.y.push_back(value);
    }
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return plot;
}

/// How the fits came to their ends.
Figure TraceFigure(const Result& result) {
  Figure figure;
  figure.caption =
      "Convergence: half the sum of whitened squares after each iteration, and what the linear "
      "model of each iteration leaves of the residuals. A fit is done where the lines are level.";
  for (const Plot& plot :
       {TracePlot(result, &IterationRecord::cost, {"cost", "", true}),
        TracePlot(result, &IterationRecord::kappa_norm, {"||J drho - dx||", "m", true})}) {
    if (!plot.series.empty()) figure.plots.push_back(plot);
  }
  return figure;
}

}  // namespace

Section SolverSection(const Result& result) {
  if (result.fits.empty()) return {};
  List endings;
  endings.kind = List::Kind::kTerms;
  for (const FitResult& fit : result.fits) {
    endings.items.push_back({Brief(fit), SolverName(fit.solver), {{fit.message, "", {}}}});
  }
  Section section{"APPENDIX: SOLVERS", {endings}};
  if (result.best() != nullptr && result.fits.size() > 1) {
    section.blocks.push_back(Paragraph{
        {fmt::format("The results above are those of {}.", SolverName(result.best()->solver))},
        ""});
  }
  for (const FitResult& fit : result.fits) {
    if (!fit.trace.empty()) section.blocks.push_back(TraceTable(fit));
  }
  const Figure traces = TraceFigure(result);
  if (!traces.empty()) section.blocks.push_back(traces);
  return section;
}

}  // namespace dhcal
