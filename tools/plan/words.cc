#include "tools/plan/words.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/rotation.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

constexpr double kNanometre = 1e-9;  // [m]

std::string Micrometres(double metres) {
  return std::isnan(metres) ? "-" : fmt::format("{:.3g}", metres / kMicrometre);
}

std::string InMicrometres(double metres) { return Micrometres(metres) + " um"; }

/// "100 poses", "12 placements".
std::string Several(const ProblemSpec& spec, int count) {
  return Counted(count, spec.robot.base_per_edge ? "placement" : "pose");
}

Table ErrorsByCount(const ProblemSpec& spec, const Plan& plan) {
  constexpr auto kRight = Table::Align::kRight;
  Table table;
  table.title = "Expected error of the predicted position in the region, RMS, 3-D";
  table.columns = {{spec.robot.base_per_edge ? "placements" : "poses", "", 12, kRight},
                   {"planned", "um", 12, kRight},
                   {"random", "um", 12, kRight},
                   {"planned, with the floor", "um", 26, kRight},
                   {"", "", 20, Table::Align::kLeft}};
  for (const PlannedError& error : plan.errors) {
    std::string remark;
    if (error.count == plan.count) remark = "written";
    if (error.count == plan.enough) remark += remark.empty() ? "enough" : ", enough";
    table.AddRow({std::to_string(error.count),
                  Micrometres(error.rms),
                  Micrometres(error.rms_random),
                  Micrometres(std::hypot(error.rms, plan.floor)),
                  remark});
  }
  return table;
}

std::string EnoughWords(const ProblemSpec& spec, const Plan& plan) {
  const std::string floor =
      plan.floor_from_fit
          ? fmt::format("what your own fit leaves ({}, 3-D RMS)", InMicrometres(plan.floor))
          : fmt::format("the noise of one reading ({}, 3-D)", InMicrometres(plan.floor));
  if (plan.enough < 0) {
    return fmt::format(
        "More still help: with all in the table the error stays above what is lost in {}. It falls "
        "as one over the root of their number.",
        floor);
  }
  return fmt::format(
      "From {} on more hardly help: with the error of the parameters, {} grows by less than {:.0f} "
      "%, which a check with the same instrument would not see. The error itself falls as one over "
      "the root of their number.",
      Several(spec, plan.enough),
      floor,
      100 * kLostInFloor);
}

std::string OwnWords(const ProblemSpec& spec, const Plan& plan) {
  const PlannedError& own = *plan.own;
  std::string text = fmt::format(
      "Your recording ({}) lets expect {}", Several(spec, own.count), InMicrometres(own.rms));
  for (const PlannedError& error : plan.errors) {
    if (error.count != plan.count) continue;
    text += fmt::format(", the plan's {} {}", Several(spec, plan.count), InMicrometres(error.rms));
    if (error.rms > 0) text += fmt::format(": {:.3g} times", own.rms / error.rms);
  }
  if (plan.own_matched_by > 0) {
    text += fmt::format("; {} of a plan would do as well", Several(spec, plan.own_matched_by));
  }
  return text + ".";
}

/// Lines for `measurement.edges`.
std::vector<std::string> EdgeLines(const Plan& plan) {
  std::vector<std::string> lines;
  for (const Edge& edge : plan.edges) {
    const Eigen::Vector3d p = edge.X_WE->translation() / kMillimetre;
    const Eigen::Vector3d rpy = RpyFromRotation(edge.X_WE->linear()) / kDegree;
    lines.push_back(
        fmt::format("{}: {{xyz_mm: [{:.0f}, {:.0f}, {:.0f}], "
                    "rpy_deg: [{:.1f}, {:.1f}, {:.1f}]}}",
                    edge.name,
                    p.x(),
                    p.y(),
                    p.z(),
                    rpy.x(),
                    rpy.y(),
                    rpy.z()));
  }
  return lines;
}

}  // namespace

Document PlanReport(const ProblemSpec& spec, const Plan& plan, const std::string& out) {
  Document document;
  document.title = "Plan of poses: " + spec.name;
  document.program = "dhcal_plan " DHCAL_VERSION;
  Paragraph head;
  head.lines = {
      fmt::format("Region: {}.", plan.region),
      fmt::format("{} of {} candidates that the nominal robot reaches; noise {} per coordinate.",
                  Several(spec, plan.count),
                  plan.candidates,
                  InMicrometres(plan.sigma))};
  document.sections.push_back({"", {head, ErrorsByCount(spec, plan)}});
  Paragraph words;
  words.lines.push_back(EnoughWords(spec, plan));
  if (plan.own) words.lines.push_back(OwnWords(spec, plan));
  if (plan.hidden > kNanometre) {
    words.lines.push_back(fmt::format(
        "No candidate shows directions that at their tolerances add {} there; they are not in the "
        "table.",
        WithMillimetres(plan.hidden)));
  }
  words.lines.insert(words.lines.end(), plan.notes.begin(), plan.notes.end());
  words.lines.emplace_back(
      "The plan knows the robot's limits, not its surroundings: check every pose for collisions "
      "and for the instrument's line of sight.");
  if (!out.empty()) words.lines.push_back(fmt::format("Written: {}.", out));
  document.sections.push_back({"", {words}});
  if (!plan.edges.empty()) {
    document.sections.push_back({"measurement.edges", {Paragraph{EdgeLines(plan), ""}}});
  }
  return document;
}

}  // namespace dhcal
