// The moves of a search for sets of effects: what to add, exchange, drop or replace so that a set's
// evidence grows.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_MOVES_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_MOVES_H_

#include <cstddef>
#include <vector>

#include "problems/diagnosis/search.h"
#include "problems/diagnosis/set_tester.h"

namespace dhcal {

std::vector<int> With(std::vector<int> members, int hypothesis);
std::vector<int> Without(std::vector<int> members, std::size_t position);

class Moves {
 public:
  /// Both must outlive the moves.
  Moves(const SearchOptions& options, SetTester* tester) : options_(options), tester_(*tester) {}

  /// Effects of a set; all lines of one joint's gear count as one.
  int CountEffects(const std::vector<int>& members) const;

  /// The names of the earlier search (`SearchOptions::start`) that still have evidence.
  std::vector<int> Start();
  /// Best single addition by evidence; the members unchanged when none helps. The scores say what
  /// each would remove; only the best few are computed with all that they bring.
  std::vector<int> BestAddition(const std::vector<int>& members) const;
  /// The addition `known`, or a line that a new scan finds where that has more evidence.
  std::vector<int> OrALine(const std::vector<int>& members, const std::vector<int>& known);
  /// Where a joint has as many lines as a curve of many orders shows, and the joint's error curve
  /// has more evidence than all that the set says of the joint's own angle, the curve takes their
  /// place.
  std::vector<int> WithCurves(std::vector<int> members);
  /// Drops and exchanges members as long as that raises the evidence.
  std::vector<int> WithSwaps(std::vector<int> members) const;
  /// A set that leaves something even with the masses free, extended by more names without new
  /// scans, with the masses as stated: the refit takes them so, and what free masses absorb here
  /// (the yielding of further joints) the refit would leave. The tester stays with the stated
  /// masses where that adds a name.
  std::vector<int> WithTheRest(const std::vector<int>& members);

 private:
  const Hypothesis& at(int idx) const { return tester_.at(idx); }
  /// Names that do not conflict, the highest score beside the members' price first; only those
  /// whose own p stands the number of names tried.
  std::vector<int> Candidates(const std::vector<int>& members) const;
  /// Drops members as long as that raises the evidence.
  std::vector<int> Pruned(std::vector<int> members) const;

  const SearchOptions& options_;
  SetTester& tester_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_MOVES_H_
