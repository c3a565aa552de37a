// Search over sets of items: several sets are kept and changed at once, by additions, removals,
// exchanges and pairs, since the best set is often not a neighbour of the best single item.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_BEAM_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_BEAM_H_

#include <map>
#include <vector>

#include "problems/diagnosis/search/gram.h"

namespace dhcal {

struct BeamOutcome {
  ItemSet best;
  std::map<ItemSet, double> seen;  // evidence of every set that was evaluated
};

/// From the starts and from nothing.
BeamOutcome SearchSets(const std::vector<ItemSet>& starts, SetEvaluator* evaluator);

/// The sets within `margin` of `reference`'s evidence, and those that are within it where a
/// parameter costs no more than it takes of noise, if they only exchange a member for a name that
/// it is easily taken for: few parameters are a reason to prefer, not to exclude. Best first, made
/// minimal: none contains another (by the ids of its items), each member pays in its set, sets of
/// equal ids are one.
std::vector<ItemSet> NotToldApart(const BeamOutcome& outcome,
                                  const ItemSet& reference,
                                  double margin,
                                  SetEvaluator* evaluator);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_BEAM_H_
