// The task: which poses to measure so that a calibration serves best.
#ifndef DHCAL_PROBLEMS_PLAN_PLAN_H_
#define DHCAL_PROBLEMS_PLAN_PLAN_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "problems/plan/candidates.h"
#include "problems/plan/exchange.h"
#include "problems/progress.h"

namespace dhcal {

struct PlanOptions {
  int count = 0;       // poses, or placements of an edge; 0 = 100, or 12
  int candidates = 0;  // 0 = 1000, or 600 placements
  DesignCriterion criterion = DesignCriterion::kD;
  std::uint64_t seed = 1;
  std::optional<TaskBox> volume;  // where the instrument sees the point, axes of the base
  EdgePlan edge;
};

/// What as many planned poses let expect in the region of the task, beside as many random ones.
/// RMS, 3-D [m], without what no pose shows.
struct PlannedError {
  int count = 0;  // poses, or placements
  double rms = 0;
  double rms_random = 0;  // median of draws from the same candidates
};

struct Plan {
  Recording rows;                    // joint coordinates and labels
  std::vector<Edge> edges;           // placements chosen, where edges are read
  std::string region;                // in words
  int count = 0;                     // chosen
  int candidates = 0;                // that there were
  double sigma = 0;                  // [m] noise of a coordinate that this is for
  std::vector<PlannedError> errors;  // by count, ascending
  double hidden = 0;  // [m] RMS in the region of what no candidate shows, at tolerances
  double floor = 0;   // [m] 3-D: noise of a reading, or what the user's own fit leaves
  bool floor_from_fit = false;
  int enough = -1;  // the smallest count of the table from which more are lost in the
                    // floor; -1 = none
  std::optional<PlannedError> own;  // of the recording that the problem file has: its readings
  int own_matched_by = -1;          // the smallest count of the table as good as it; -1 = none
  std::vector<std::string> notes;   // sentences
};

/// More poses stop helping where the predicted error and the floor together are within this share
/// of the floor alone: a check with the same instrument would not see the difference.
constexpr double kLostInFloor = 0.1;

/// `own` (may be null): the recording that the problem file has. Nothing, with an error added,
/// where the noise is unknown or the robot reaches too little.
std::optional<Plan> PlanPoses(const ProblemSpec& spec,
                              const Recording* own,
                              const PlanOptions& options,
                              Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_PLAN_H_
