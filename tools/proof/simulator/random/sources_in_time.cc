// Causes that depend on the clock, the row or the run.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/cause_sources.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

/// The first row after a moment that is drawn, and that moment.
int RowOfStep(const Subject& of, Rng* rng, double* time) {
  const auto poses = static_cast<double>(of.trial.motion.num_poses());
  const int row = static_cast<int>(rng->Uniform(0.15, 0.85) * poses);
  *time = 0.5 * (of.trial.motion.time[row - 1] + of.trial.motion.time[row]);
  return row;
}

/// A turn about the first axis is one of the base; of a single target on the last axis, a shift of
/// the tool.
void SayWhatStepsAreSame(const Subject& of, Cause* cause) {
  if (cause->joint == 1) cause->same.emplace_back("base_step", 0);
  if (cause->joint == of.num_joints()) cause->same.emplace_back("tool_step", 0);
}

/// A joint, the base, the tool or the length of a row, in words.
std::string RandomSlot(const Subject& of, Rng* rng) {
  switch (DrawIndex({0.5, 0.2, 0.15, 0.15}, rng)) {
    case 0:
      return fmt::format("theta{}", DrawFrom(of.turning, rng));
    case 1:
      return fmt::format("base_{}", "xyz"[DrawInt(3, rng)]);
    case 2:
      return fmt::format("tool_{}", "xz"[DrawInt(2, rng)]);
    default:
      return fmt::format("a{}", 2 + DrawInt(of.num_joints() - 2, rng));
  }
}

Move RandomMove(double shift, double turn, Rng* rng) {
  return {shift * DrawDirection(rng), turn * DrawDirection(rng)};
}

}  // namespace

std::vector<CauseSource> SourcesInTime(const Subject& subject) {
  const Settings& s = subject.trial.settings;
  // A drift begins anew with every run in the files, and differences hardly see it.
  const bool warms = s.runs == 1;
  return {
      {1.5,
       warms,
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.08, 0.6);
         return Causes{BaseDrifts(strength * 1.5e-4 * DrawDirection(rng), lag)};
       }},
      {1,
       warms,
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.08, 0.6);
         return Causes{
             JointDrifts(DrawFrom(of.turning, rng), DrawSign(rng) * strength * 1e-4, lag)};
       }},
      {1,
       warms && subject.trial.drawing.name != "scara",
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.1, 0.5);
         return Causes{Chance(0.5, rng) ? FirstLinkGrows(strength * 1e-4, lag)
                                        : SecondLinkGrows(strength * 1e-4, lag)};
       }},
      {2,
       warms,
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.08, 0.6);
         return Causes{InstrumentGrows(DrawSign(rng) * strength * 2e-5, lag)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         return Causes{ToolSlips(row, time, strength * 1e-4 * DrawDirection(rng))};
       }},
      {1.5,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         Cause cause =
             JointSlips(DrawFrom(of.turning, rng), row, time, DrawSign(rng) * strength * 1e-4);
         SayWhatStepsAreSame(of, &cause);
         return Causes{cause};
       }},
      {1,
       s.kind != Kind::kAdjacent,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         return Causes{BaseSteps(row, time, RandomMove(strength * 1e-4, strength * 0.5e-4, rng))};
       }},
      {1,
       s.order == Order::kStreamed,
       [](const Subject& /*of*/, double strength, Rng* rng) {
         return Causes{Late(DrawSign(rng) * strength * 0.3e-3)};
       }},
      {0.7,
       // Repeats of a pose stand still: the arm settles between them.
       s.order == Order::kRandom && s.repeats == 1,
       [](const Subject& /*of*/, double strength, Rng* /*rng*/) {
         return Causes{NotSettled(strength * 0.5e-4)};
       }},
      {4,
       !subject.trial.columns.empty(),
       [](const Subject& of, double strength, Rng* rng) {
         const RecordedColumn& column = DrawFrom(of.trial.columns, rng);
         const double amount = DrawSign(rng) * strength * 1e-4;
         return Causes{Follows(column.name, RandomSlot(of, rng), column.course, amount)};
       }},
      {3, s.kind == Kind::kDistance, [](const Subject& of, double strength, Rng* /*rng*/) {
         return Causes{ReadsLong(strength * 1e-4, static_cast<int>(of.trial.anchors.size()))};
       }}};
}

}  // namespace dhcal::concealed
