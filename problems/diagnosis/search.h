// Which effects are there? Detection, naming, confusion and abstention in one procedure: the
// confidence set over hypotheses of PHYSICS.md M3, for single effects and, where none
// suffices, for sets found by forward, backward and swap moves.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_H_

#include <string>
#include <vector>

#include "core/analysis/block_tests.h"
#include "problems/diagnosis/hypotheses.h"
#include "problems/diagnosis/spectrum.h"

namespace dhcal {

struct SearchOptions {
  double false_alarm = 0.01;  // family-wise
  bool sigma_known = false;
  double nu = 0;                     // freedom of the rows beside the geometry
  std::vector<std::string> effects;  // names that may be given; empty = all
  int max_effects = 12;              // with free masses; lines of one joint's gear count as one
  int draws = 2000;
  std::uint64_t seed = 1;
  std::vector<EffectRequest> start;  // names that an earlier search of the same readings found
};

/// A set of hypotheses (indices into the space) and how well it stands.
struct TestedSet {
  std::vector<int> members;
  double p = 0;       // of what it leaves, Monte-Carlo and scan together
  bool kept = false;  // not rejected
};

struct SearchOutcome {
  double p_geometry = 1;  // that geometry and noise are all
  bool consistent = true;
  std::vector<BlockScore> scores;  // of every block beside the geometry alone
  std::vector<int> accepted;       // the best set of names; may be empty
  bool complete = false;           // nothing significant is left beside them
  double p_accepted = 0;
  std::vector<TestedSet> tested;  // the confidence set and what was rejected from it
  std::vector<int> anonymous;     // map blocks that describe the rest, largest first
  double removed_by_names = 0;    // squares
  double removed_by_all = 0;      // with the anonymous ones
};

/// May add hypotheses to the space (peaks of the spectrum, refined instants).
SearchOutcome Search(const SearchOptions& options, HypothesisSpace* space);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_H_
