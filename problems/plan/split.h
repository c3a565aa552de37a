// Poses that tell apart what a diagnosis could not: the alternatives of an ambiguous verdict.
//
//   s_ab^2 = min over g, b of || x_a - J g - E_b b ||^2
//
// x_a is what alternative a, as large as the recording shows it, does to the whitened readings, J
// the geometry within its tolerances (rows of these are part of the squares), E_b the columns of b,
// of any size: how many standard deviations stay between the two after everything else has absorbed
// what it can. T-optimal (Atkinson, Fedorov 1975): each pose is the one that lowers the chance that
// any pair stays together most.
#ifndef DHCAL_PROBLEMS_PLAN_SPLIT_H_
#define DHCAL_PROBLEMS_PLAN_SPLIT_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/task.h"

namespace dhcal {

struct SplitOptions {
  int count = 10;        // poses
  int candidates = 400;  // with their approach directions and payloads
  std::uint64_t seed = 1;
  std::optional<TaskBox> volume;  // axes of the base
};

/// Effects that together explain a misfit.
using Alternative = std::vector<EffectRequest>;

struct SplitPair {
  std::string truth, other;
  double before = 0, after = 0;  // s_ab by the recording alone, and with the poses
};

struct SplitPlan {
  Recording rows;  // joint coordinates, and approach directions or payloads where they matter
  std::vector<std::string> alternatives;
  std::vector<SplitPair> pairs;
  std::vector<std::string> notes;
};

/// The sets of effects that a diagnosis keeps, those whose effects all have names.
std::vector<Alternative> AlternativesOf(const std::vector<HypothesisResult>& hypotheses);

/// "joint_compliance at joint 2 + backlash at joint 4".
std::string AlternativeName(const Alternative& alternative);

/// Nothing, with an error added, where fewer than two alternatives depend on what poses can choose:
/// joint angles, approach directions, payloads and temperatures that the recording has.
std::optional<SplitPlan> PlanSplit(const ProblemSpec& spec,
                                   const Recording& own,
                                   const std::vector<Alternative>& alternatives,
                                   const SplitOptions& options,
                                   Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_SPLIT_H_
