#include "problems/diagnosis/search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "problems/diagnosis/set_tester.h"

namespace dhcal {
namespace {

constexpr int kMostAnonymous = 8;
constexpr std::size_t kMostSwapsTried = 12;  // candidates per member
constexpr std::size_t kMostExchanged = 4;    // members whose alternatives are all tested
constexpr double kBetterPart = 0.5;

bool IsTorque(const std::string& driver) { return driver.find("torque") != std::string::npos; }

class Searcher {
 public:
  Searcher(const SearchOptions& options, HypothesisSpace* space)
      : options_(options), space_(space), tester_(options, space) {}

  SearchOutcome Run() {
    SearchOutcome out;
    out.scores = tester_.tests().Scores({});
    const ModelTest geometry = tester_.tests().Test({}, options_.false_alarm);
    const std::vector<SpectralPeak> peaks = tester_.Scan({});
    out.p_geometry = Combine(geometry.p, SetTester::LeastScan(peaks));
    out.consistent = out.p_geometry > options_.false_alarm;
    out.tested.push_back({{}, out.p_geometry, out.consistent});
    if (out.consistent) return out;
    tester_.AddPeaks(peaks, {});
    tester_.AddRefined({});
    tester_.Rebuild();
    TrySingles(&out);
    if (out.accepted.empty() && !TryAnonymous(&out)) TrySets(&out);
    DescribeRest(&out);
    out.scores = tester_.tests().Scores({});
    return out;
  }

 private:
  const Hypothesis& at(int idx) const { return tester_.at(idx); }

  void TrySingles(SearchOutcome* out) const {
    std::map<std::string, std::size_t> of_family;
    for (const int k : tester_.names()) {
      TestedSet set = tester_.Try({k}, /*rescan=*/true);
      // Of one family only the best setting counts: they are one hypothesis.
      const auto [entry, is_new] = of_family.try_emplace(at(k).family, out->tested.size());
      if (is_new) {
        out->tested.push_back(set);
        continue;
      }
      TestedSet& known = out->tested[entry->second];
      const bool better = set.kept != known.kept
                              ? set.kept
                              : tester_.Evidence(set.members) > tester_.Evidence(known.members);
      if (better) known = set;
    }
    ChooseSingle(out);
  }

  /// The kept set with the best evidence becomes the answer.
  void ChooseSingle(SearchOutcome* out) const {
    double best = -1e300;
    for (const TestedSet& set : out->tested) {
      if (!set.kept || set.members.empty()) continue;
      const double evidence = tester_.Evidence(set.members);
      if (evidence <= best) continue;
      best = evidence;
      out->accepted = set.members;
      out->p_accepted = set.p;
      out->complete = true;
    }
  }

  /// One anonymous cause that leaves nothing is more likely than a set of names that do: a damaged
  /// tooth is not three gear errors. Functions of a torque are left to the names. True when there
  /// is one; the best becomes the description.
  bool TryAnonymous(SearchOutcome* out) const {
    double best = -1e300;
    for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
      const Hypothesis& h = at(k);
      if (h.named || !h.in_maximum || IsTorque(h.driver)) continue;
      if (!tester_.Try({k}, /*rescan=*/false).kept) continue;
      const double evidence = tester_.Evidence({k});
      if (evidence <= best) continue;
      best = evidence;
      out->anonymous = {k};
    }
    return !out->anonymous.empty();
  }

  /// Two or more names that are functions of one joint's own angle, where one curve of that angle
  /// does as well: the joint is right, the names are not known.
  void DropCurves(std::vector<int>* members, SearchOutcome* out) const {
    for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
      const Hypothesis& h = at(k);
      if (h.named || !h.in_maximum || h.slot.rfind("theta", 0) != 0) continue;
      if (h.driver != "q" + h.slot.substr(5)) continue;
      std::vector<int> kept, curves;
      for (const int m : *members) {
        const bool own = "theta" + std::to_string(at(m).request.joint) == h.slot &&
                         at(m).place.driver == "joint angle";
        (own ? curves : kept).push_back(m);
      }
      if (CountEffects(curves) < 2) continue;
      const TestedSet set = tester_.Try(With(kept, k), /*rescan=*/false);
      if (!set.kept) continue;
      *members = kept;
      out->anonymous.push_back(k);
      out->complete = false;
      out->p_accepted = set.p;
    }
  }

  /// Names that do not conflict, the highest score beside the members' price first; only those
  /// whose own p stands the number of names tried.
  std::vector<int> Candidates(const std::vector<int>& members) const {
    const BlockModel model = tester_.Model(members);
    const std::vector<BlockScore> scores = tester_.tests().Scores(model);
    const auto count = static_cast<double>(tester_.names().size());
    const double left = tester_.tests().gram().rss - tester_.tests().Removed(model);
    std::vector<std::pair<double, int>> ranked;
    for (const int k : tester_.names()) {
      const BlockScore& score = scores[static_cast<std::size_t>(k)];
      if (tester_.Conflicts(k, members)) continue;
      if (score.p * count > options_.false_alarm) continue;
      ranked.emplace_back(tester_.Gain(score.Q, left) - at(k).columns.size * std::log(options_.nu),
                          k);
    }
    std::sort(ranked.begin(), ranked.end(), std::greater<>());
    std::vector<int> candidates;
    for (const auto& [evidence, k] : ranked) candidates.push_back(k);
    return candidates;
  }

  static std::vector<int> With(std::vector<int> members, int k) {
    members.push_back(k);
    return members;
  }
  static std::vector<int> Without(std::vector<int> members, std::size_t position) {
    members.erase(members.begin() + static_cast<long>(position));
    return members;
  }

  /// Best single addition by evidence; the members unchanged when none helps. The scores say what
  /// each would remove; only the best few are computed with all that they bring.
  std::vector<int> BestAddition(const std::vector<int>& members) const {
    constexpr std::size_t kMostCompared = 4;
    std::vector<int> best = members;
    double best_evidence = tester_.Evidence(members);
    const std::vector<int> candidates = Candidates(members);
    for (std::size_t i = 0; i < std::min(candidates.size(), kMostCompared); ++i) {
      const std::vector<int> tried = With(members, candidates[i]);
      const double evidence = tester_.Evidence(tried);
      if (evidence <= best_evidence) continue;
      best_evidence = evidence;
      best = tried;
    }
    return best;
  }

  /// The addition `known`, or a line that a new scan finds where that has more evidence.
  std::vector<int> OrALine(const std::vector<int>& members, const std::vector<int>& known) {
    const double evidence = tester_.Evidence(known);
    const std::vector<SpectralPeak> peaks = tester_.Scan(members);
    double best = -1e300;
    SpectralPeak highest;
    for (const SpectralPeak& peak : peaks) {
      if (peak.p_scan <= options_.false_alarm && peak.Q > highest.Q) highest = peak;
    }
    if (highest.joint >= 0) best = tester_.EvidenceWith(highest, members);
    const bool better = best > evidence;
    if (!better || !tester_.AddPeaks(peaks, members)) return known;
    tester_.Rebuild();
    return BestAddition(members);
  }

  /// Where a joint has as many lines as a curve of many orders shows, and the joint's error curve
  /// has more evidence than all that the set says of the joint's own angle, the curve takes their
  /// place.
  std::vector<int> WithCurves(std::vector<int> members) {
    constexpr int kLinesOfACurve = 3;
    std::map<int, int> lines;
    for (const int k : members) {
      if (at(k).request.setting("order", 0) >= kLowestOrder) ++lines[at(k).request.joint];
    }
    for (const auto& [joint, count] : lines) {
      if (count < kLinesOfACurve) continue;
      const int curve = tester_.Curve(joint);
      if (curve < 0 || std::find(members.begin(), members.end(), curve) != members.end()) continue;
      std::vector<int> tried;
      for (const int k : members) {
        if (!tester_.Conflicts(curve, {k})) tried.push_back(k);
      }
      tried.push_back(curve);
      if (tester_.Evidence(tried) > tester_.Evidence(members)) members = tried;
    }
    return members;
  }

  /// Drops and exchanges members as long as that raises the evidence.
  std::vector<int> WithSwaps(std::vector<int> members) const {
    for (int round = 0; round < 4; ++round) {
      std::vector<int> best = members;
      double best_evidence = tester_.Evidence(members);
      const auto consider = [&](const std::vector<int>& tried) {
        const double evidence = tester_.Evidence(tried);
        if (evidence <= best_evidence) return;
        best_evidence = evidence;
        best = tried;
      };
      for (std::size_t i = 0; i < members.size(); ++i) {
        const std::vector<int> without = Without(members, i);
        consider(without);
        std::vector<int> candidates = Candidates(without);
        candidates.resize(std::min(candidates.size(), kMostSwapsTried));
        for (const int k : candidates) consider(With(without, k));
      }
      if (best == members) break;
      members = best;
    }
    return members;
  }

  /// Effects of a set; all lines of one joint's gear count as one.
  int CountEffects(const std::vector<int>& members) const {
    std::set<std::pair<std::string, int>> distinct;
    for (const int k : members) distinct.insert({at(k).request.effect, at(k).request.joint});
    return static_cast<int>(distinct.size());
  }

  void TrySets(SearchOutcome* out) {
    std::vector<int> members;
    while (CountEffects(members) < options_.max_effects) {
      const std::vector<int> more = OrALine(members, BestAddition(members));
      if (more.size() == members.size()) {
        // Nothing known helps; a better instant may.
        const std::size_t before = space_->all().size();
        tester_.AddRefined(members);
        if (space_->all().size() == before) break;
        tester_.Rebuild();
        if (BestAddition(members).size() == members.size()) break;
        continue;
      }
      members = more.size() <= kMostExchanged ? tester_.Polished(WithSwaps(more)) : more;
      members = WithCurves(members);
      const TestedSet set = tester_.Try(members, /*rescan=*/true);
      out->p_accepted = set.p;
      if (!set.kept) continue;
      out->complete = true;
      break;
    }
    if (members.size() > kMostExchanged) members = tester_.Polished(members);
    if (out->complete) members = Needed(members, out);
    if (out->complete) DropCurves(&members, out);
    out->accepted = members;
    if (members.empty()) return;
    out->tested.push_back({members, out->p_accepted, out->complete});
    if (out->complete) TryExchanges(members, out);
  }

  /// Drops members without which nothing significant is left either, the weakest first.
  std::vector<int> Needed(std::vector<int> members, SearchOutcome* out) const {
    for (bool dropped = true; dropped && members.size() > 1;) {
      dropped = false;
      std::vector<std::pair<double, std::size_t>> order;
      for (std::size_t i = 0; i < members.size(); ++i) {
        order.emplace_back(-tester_.Evidence(Without(members, i)), i);
      }
      std::sort(order.begin(), order.end());
      for (const auto& [evidence, i] : order) {
        const TestedSet set = tester_.Try(Without(members, i), /*rescan=*/true);
        if (!set.kept) continue;
        members = set.members;
        out->p_accepted = set.p;
        dropped = true;
        break;
      }
    }
    return members;
  }

  /// The confidence set over the sets that one exchange reaches.
  void TryExchanges(const std::vector<int>& members, SearchOutcome* out) const {
    for (std::size_t i = 0; i < members.size() && i < kMostExchanged; ++i) {
      const std::vector<int> without = Without(members, i);
      std::map<std::string, TestedSet> of_family;
      for (const int k : tester_.names()) {
        if (tester_.Conflicts(k, without) || at(k).family == at(members[i]).family) continue;
        const TestedSet set = tester_.Try(With(without, k), /*rescan=*/false);
        if (set.kept) of_family.emplace(at(k).family, set);
      }
      for (const auto& [family, set] : of_family) out->tested.push_back(set);
    }
  }

  /// Anonymous blocks that describe what the names leave.
  void DescribeRest(SearchOutcome* out) const {
    const BlockTests& tests = tester_.tests();
    BlockModel model = tester_.Model(out->accepted);
    out->removed_by_names = tests.Removed(model);
    out->removed_by_all = out->removed_by_names;
    if (out->complete) return;
    for (const int block : out->anonymous) {
      for (const int column : tests.Columns(block)) model.columns.push_back(column);
    }
    const auto count = static_cast<double>(space_->all().size());
    while (static_cast<int>(out->anonymous.size()) < kMostAnonymous) {
      const std::vector<BlockScore> scores = tests.Scores(model);
      int best = -1;
      for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
        const BlockScore& score = scores[static_cast<std::size_t>(k)];
        if (at(k).named || !at(k).in_maximum || score.p * count > options_.false_alarm) continue;
        if (best < 0 || score.z > scores[static_cast<std::size_t>(best)].z) best = k;
      }
      if (best < 0) break;
      out->anonymous.push_back(best);
      for (const int column : tests.Columns(best)) model.columns.push_back(column);
    }
    out->removed_by_all = tests.Removed(model);
    KeepWhatSurvives(model, out);
  }

  /// A name must survive the best anonymous description of the rest, and the names together must
  /// be the better part of it: else they are a chance likeness, not the cause.
  void KeepWhatSurvives(const BlockModel& with_rest, SearchOutcome* out) const {
    const BlockTests& tests = tester_.tests();
    const auto count = static_cast<double>(tester_.names().size());
    std::vector<int> surviving;
    for (const int k : out->accepted) {
      BlockModel without = with_rest;
      std::vector<int> own = tests.Columns(k);
      for (const int block : out->anonymous) {
        // A free curve over the name's own torque holds the name: it is what else that torque does.
        const Hypothesis& curve = at(block);
        if (curve.slot != "theta" + std::to_string(at(k).request.joint)) continue;
        if (curve.driver != at(k).place.driver || !IsTorque(curve.driver)) continue;
        const std::vector<int> columns = tests.Columns(block);
        own.insert(own.end(), columns.begin(), columns.end());
      }
      without.columns.erase(
          std::remove_if(without.columns.begin(),
                         without.columns.end(),
                         [&](int c) { return std::find(own.begin(), own.end(), c) != own.end(); }),
          without.columns.end());
      const BlockScore score = tests.Score(without, k);
      if (score.k > 0 && score.p * count < options_.false_alarm) surviving.push_back(k);
    }
    const double removed = tests.Removed(tester_.Model(surviving));
    if (removed < kBetterPart * out->removed_by_all) surviving.clear();
    out->accepted = surviving;
    out->removed_by_names = surviving.empty() ? 0 : removed;
  }

  const SearchOptions& options_;
  HypothesisSpace* space_;
  SetTester tester_;
};

}  // namespace

SearchOutcome Search(const SearchOptions& options, HypothesisSpace* space) {
  return Searcher(options, space).Run();
}

}  // namespace dhcal
