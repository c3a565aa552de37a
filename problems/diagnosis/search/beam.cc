#include "problems/diagnosis/search/beam.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

constexpr int kBeamRounds = 8;
constexpr std::size_t kEvaluated = 40;      // of the promises of one front set
constexpr std::size_t kPairsUpTo = 4;       // members: pairs beside every removal
constexpr std::size_t kPairsAtAllUpTo = 8;  // members: pairs beside single removals
constexpr std::size_t kDoubleDropsUpTo = 7;

/// Nothing, each member, each two members.
std::vector<ItemSet> Removals(const ItemSet& set) {
  std::vector<ItemSet> removals = {{}};
  for (const int i : set) removals.emplace_back(1, i);
  if (set.size() > kDoubleDropsUpTo) return removals;
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t k = i + 1; k < set.size(); ++k) removals.push_back({set[i], set[k]});
  }
  return removals;
}

std::vector<ItemSet> Best(const std::map<ItemSet, double>& seen, std::size_t count) {
  std::vector<std::pair<double, ItemSet>> all;
  for (const auto& [set, evidence] : seen) all.emplace_back(evidence, set);
  std::sort(all.begin(), all.end());
  std::vector<ItemSet> best;
  for (std::size_t k = 0; k < all.size() && k < count; ++k) best.push_back(all[k].second);
  return best;
}

std::set<std::string> IdsOf(const ItemSet& set, const SetEvaluator& evaluator) {
  std::set<std::string> ids;
  for (const int i : set) ids.insert(evaluator.items()[static_cast<std::size_t>(i)].id);
  return ids;
}

bool Contains(const std::set<std::string>& set, const std::set<std::string>& part) {
  return std::includes(set.begin(), set.end(), part.begin(), part.end());
}

/// The set with each member exchanged for each other name that it is easily taken for.
std::vector<ItemSet> Exchanged(const ItemSet& set, const SetEvaluator& evaluator) {
  const std::vector<GramItem>& items = evaluator.items();
  std::vector<ItemSet> exchanged;
  for (const int member : set) {
    const GramItem& own = items[static_cast<std::size_t>(member)];
    const ItemSet others = Without(set, ItemSet(1, member));
    const std::set<std::string> ids = IdsOf(set, evaluator);
    for (std::size_t k = 0; k < items.size(); ++k) {
      const bool alike = !own.taken_for.empty() && items[k].taken_for == own.taken_for;
      if (alike && ids.count(items[k].id) == 0) {
        exchanged.push_back(With(others, static_cast<int>(k)));
      }
    }
  }
  return exchanged;
}

}  // namespace

BeamOutcome SearchSets(const std::vector<ItemSet>& starts, SetEvaluator* evaluator) {
  BeamOutcome outcome;
  const auto see = [&](const ItemSet& set) {
    if (static_cast<int>(set.size()) > kTuning.most_members) return;
    if (outcome.seen.count(set) > 0) return;
    outcome.seen[set] = evaluator->Evaluate(set).evidence;
  };
  for (const ItemSet& start : starts) see(start);
  see({});
  std::set<ItemSet> done;
  for (int round = 0; round < kBeamRounds; ++round) {
    std::vector<ItemSet> front;
    for (const ItemSet& set : Best(outcome.seen, static_cast<std::size_t>(kTuning.beam))) {
      const auto most = static_cast<std::size_t>(std::max(2, kTuning.beam / 2));
      if (done.count(set) == 0 && front.size() < most) front.push_back(set);
    }
    if (front.empty()) break;
    for (const ItemSet& set : front) {
      done.insert(set);
      std::vector<SetEvaluator::Promise> promises;
      for (const ItemSet& removal : Removals(set)) {
        const ItemSet base = Without(set, removal);
        see(base);
        const bool pairs =
            set.size() <= kPairsUpTo || (removal.size() < 2 && set.size() <= kPairsAtAllUpTo);
        const auto larger = evaluator->Larger(base, pairs);
        promises.insert(promises.end(), larger.begin(), larger.end());
      }
      std::sort(promises.begin(), promises.end(), [](const auto& a, const auto& b) {
        return a.evidence != b.evidence ? a.evidence < b.evidence : a.set < b.set;
      });
      for (std::size_t k = 0; k < promises.size() && k < kEvaluated; ++k) see(promises[k].set);
    }
  }
  outcome.best = Best(outcome.seen, 1).front();
  return outcome;
}

std::vector<ItemSet> NotToldApart(const BeamOutcome& outcome,
                                  const ItemSet& reference,
                                  double margin,
                                  SetEvaluator* evaluator) {
  const double limit = evaluator->Evaluate(reference).evidence + margin;
  std::map<ItemSet, double> near;
  for (const auto& [set, evidence] : outcome.seen) {
    if (evidence <= limit) near[set] = evidence;
  }
  for (const ItemSet& set : Exchanged(reference, *evaluator)) {
    if (evaluator->FrugalEvidence(set) > evaluator->FrugalEvidence(reference) + margin) continue;
    near[set] = evaluator->Evaluate(set).evidence;
  }
  std::vector<ItemSet> listed;
  std::vector<std::set<std::string>> ids_listed;
  for (const ItemSet& set : Best(near, near.size())) {
    if (static_cast<int>(listed.size()) >= kTuning.longest_list) break;
    const std::set<std::string> ids = IdsOf(set, *evaluator);
    const bool larger = std::any_of(ids_listed.begin(), ids_listed.end(), [&](const auto& other) {
      return Contains(ids, other);
    });
    if (larger) continue;
    const bool each_pays = std::all_of(set.begin(), set.end(), [&](int i) {
      return evaluator->Evaluate(Without(set, ItemSet(1, i))).evidence > near.at(set);
    });
    if (!each_pays) continue;
    listed.push_back(set);
    ids_listed.push_back(ids);
  }
  return listed;
}

}  // namespace dhcal
