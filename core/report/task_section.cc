// What a calibration lets expect where accuracy matters.
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

std::string Interval(const RegionError& error) {
  return fmt::format("{} to {}", Millimetres(error.low), Millimetres(error.high));
}

Table TaskTable(const TaskError& task) {
  constexpr auto kPoint = Table::Align::kPoint;
  Table table;
  table.title = "Error of the predicted position in the task's region, 3-D";
  table.columns = {{"", "", 52, Table::Align::kLeft},
                   {"RMS", "mm", 12, kPoint},
                   {"95 % interval", "mm", 24, Table::Align::kLeft}};
  table.AddRow(
      {"nominal robot, base and tool fitted", Millimetres(task.before.rms), Interval(task.before)});
  table.AddRow({"calibrated, as far as the readings determine it",
                Millimetres(task.after.rms),
                Interval(task.after)});
  table.AddRow({"  one sigma at the worst pose", Millimetres(task.after_largest), ""});
  table.AddRow(
      {"hidden: what no reading determines, at its tolerance", Millimetres(task.hidden), ""});
  return table;
}

}  // namespace

std::string TaskSentence(const Result& result) {
  if (!result.task) return "";
  const TaskError& task = *result.task;
  if (!task.unknown.empty()) return task.unknown + ".";
  return fmt::format(
      "In the region of the task ({}), 3-D RMS: {} with the nominal robot, {} expected with "
      "calibrated.yaml (95 %: {} mm); what no reading determines may add {}.",
      task.region,
      WithMillimetres(task.before.rms),
      WithMillimetres(task.after.rms),
      Interval(task.after),
      WithMillimetres(task.hidden));
}

Section TaskSection(const Result& result) {
  if (!result.task) return {};
  const TaskError& task = *result.task;
  Section section{"TASK", {}};
  if (!task.unknown.empty()) {
    section.blocks.push_back(Paragraph{{task.unknown + "."}, ""});
    return section;
  }
  Paragraph text;
  text.lines = {fmt::format("Region: {}.", task.region),
                "These are errors of the model's parameters alone: the robot's repeatability and "
                "what the model leaves out come on top."};
  if (task.aligned) {
    text.lines.emplace_back(
        "The readings know no base that all rows share: errors are told after the region as a "
        "whole was moved to fit best.");
  }
  if (!task.left_out.empty()) {
    text.lines.push_back(fmt::format("Not in these figures, since more than the pose decides: {}.",
                                     fmt::join(task.left_out, ", ")));
  }
  section.blocks = {text, TaskTable(task)};
  return section;
}

}  // namespace dhcal
