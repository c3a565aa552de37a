// How each solver ended, step by step.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/format.h"
#include "core/report/sections.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

constexpr std::size_t kFirstSteps = 12;  // of a long trace
constexpr std::size_t kLastSteps = 4;

std::string Ending(const FitResult& fit) {
  if (fit.termination == Termination::kNotRun) return "not run";
  if (!fit.usable) return "no usable result";
  return fit.converged ? "converged" : "not converged, but usable";
}

std::string BriefLine(const FitResult& fit) {
  std::string text = Ending(fit);
  if (fit.iterations >= 0) text += ", " + Counted(fit.iterations, "iteration");
  if (fit.rank >= 0) text += fmt::format(", rank {} of {}", fit.rank, fit.columns);
  if (!std::isnan(fit.cost)) text += fmt::format(", cost {:.4e}", fit.cost);
  if (!std::isnan(fit.seconds)) text += fmt::format(", {:.3g} s", fit.seconds);
  return Wrap(fmt::format("  {:<20}", SolverName(fit.solver)), text);
}

void AddStep(const IterationRecord& record, TextTable* table) {
  table->AddRow({record.iteration < 0 ? "-" : std::to_string(record.iteration),
                 Scientific(record.cost, 4),
                 Scientific(record.kappa_norm, 4),
                 record.rank < 0 ? "-" : std::to_string(record.rank),
                 Scientific(record.step_norm, 3)});
}

/// Columns of fixed width: the tables of two solvers can be read one under the other.
std::string TraceTable(const std::vector<IterationRecord>& trace) {
  constexpr auto kRight = TextTable::Align::kRight;
  TextTable table({{"iteration", "", 9, kRight, 9},
                   {"cost", "", 12, kRight, 12},
                   {"||J drho - dx|| [m]", "", 12, kRight, 19},
                   {"rank", "", 6, kRight, 6},
                   {"step [tolerances]", "", 12, kRight, 17}});
  const bool is_long = trace.size() > kFirstSteps + kLastSteps + 1;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    if (is_long && i == kFirstSteps) {
      const std::size_t left_out = trace.size() - kFirstSteps - kLastSteps;
      table.AddLine(AndMore(left_out));
      i += left_out;
    }
    AddStep(trace[i], &table);
  }
  return table.ToString();
}

}  // namespace

std::string SolverSection(const Result& result) {
  if (result.fits.empty()) return "";
  std::string text = Heading("SOLVERS");
  for (const FitResult& fit : result.fits) {
    text += BriefLine(fit) + Wrap("    ", fit.message);
  }
  if (result.best() != nullptr && result.fits.size() > 1) {
    text += Wrap(
        "  ", fmt::format("What follows is the result of {}.", SolverName(result.best()->solver)));
  }
  for (const FitResult& fit : result.fits) {
    if (fit.trace.empty()) continue;
    text += fmt::format("\n  Iterations of {}\n", SolverName(fit.solver)) + TraceTable(fit.trace);
  }
  return text;
}

}  // namespace dhcal
