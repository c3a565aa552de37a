#include "problems/diagnosis/search.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "core/physics/registry.h"
#include "problems/diagnosis/moves.h"
#include "problems/diagnosis/set_tester.h"
#include "problems/diagnosis/spectrum.h"

namespace dhcal {
namespace {

constexpr int kMostAnonymous = 8;
constexpr std::size_t kMostExchanged = 4;  // members whose alternatives are all tested
constexpr double kBetterPart = 0.5;
constexpr int kLinesOfAShape = 4;

class Searcher {
 public:
  Searcher(const SearchOptions& options, HypothesisSpace* space)
      : options_(options), space_(space), tester_(options, space), moves_(options, &tester_) {}

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
      if (h.named || !h.in_maximum || h.driver.is_torque()) continue;
      if (!tester_.Try({k}, /*rescan=*/false).kept) continue;
      const double evidence = tester_.Evidence({k});
      if (evidence <= best) continue;
      best = evidence;
      out->anonymous = {k};
    }
    return !out->anonymous.empty();
  }

  /// Two or more names that are functions of one joint's own angle, where one curve of that angle
  /// does as well, or many lines of low orders, the Fourier series of some shape such as a damaged
  /// tooth's: the joint is right, the names are not known.
  void DropCurves(std::vector<int>* members, SearchOutcome* out) const {
    for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
      const Hypothesis& h = at(k);
      if (h.named || !h.in_maximum || h.slot_joint == 0) continue;
      if (!(h.driver == Driver{DriverKind::kJointAngle, h.slot_joint})) continue;
      std::vector<int> kept, curves;
      for (const int m : *members) {
        const bool own = at(m).request.joint == h.slot_joint && IsOfOwnAngle(at(m));
        (own ? curves : kept).push_back(m);
      }
      const auto low_line = [&](int m) {
        return at(m).effect == &LineEffect() && tester_.InCurve(m);
      };
      const bool series = std::count_if(curves.begin(), curves.end(), low_line) >= kLinesOfAShape;
      if (!series && (!out->complete || moves_.CountEffects(curves) < 2)) continue;
      TestedSet set = tester_.Try(With(kept, k), /*rescan=*/false);
      if (!series && !set.kept) continue;
      if (!set.kept) {
        // The curve does not do as well: names that are no part of the series stay.
        std::copy_if(curves.begin(), curves.end(), std::back_inserter(kept), std::not_fn(low_line));
        set = tester_.Try(With(kept, k), /*rescan=*/false);
      }
      *members = kept;
      out->anonymous.push_back(k);
      out->complete = false;
      out->p_accepted = set.p;
    }
  }

  void TryExtended(std::vector<int>* members, SearchOutcome* out) {
    const std::vector<int> extended = moves_.WithTheRest(*members);
    if (extended == *members) return;
    *members = extended;
    const TestedSet set = tester_.Try(extended, /*rescan=*/true);
    out->p_accepted = set.p;
    out->complete = set.kept;
  }

  void TrySets(SearchOutcome* out) {
    std::vector<int> members = moves_.Start();
    if (!members.empty()) {
      const TestedSet set = tester_.Try(members, /*rescan=*/true);
      out->p_accepted = set.p;
      out->complete = set.kept;
    }
    while (!out->complete && moves_.CountEffects(members) < options_.max_effects) {
      const std::vector<int> more = moves_.OrALine(members, moves_.BestAddition(members));
      if (more.size() == members.size()) {
        // Nothing known helps; a better instant may.
        const std::size_t before = space_->all().size();
        tester_.AddRefined(members);
        if (space_->all().size() == before) break;
        tester_.Rebuild();
        if (moves_.BestAddition(members).size() == members.size()) break;
        continue;
      }
      members = more.size() <= kMostExchanged ? tester_.Polished(moves_.WithSwaps(more)) : more;
      members = moves_.WithCurves(members);
      const TestedSet set = tester_.Try(members, /*rescan=*/true);
      out->p_accepted = set.p;
      if (!set.kept) continue;
      out->complete = true;
      break;
    }
    if (members.size() > kMostExchanged) members = tester_.Polished(members);
    if (!out->complete) TryExtended(&members, out);
    if (out->complete) members = Needed(members, out);
    DropCurves(&members, out);
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

  /// Probability that the order scan's or the names' strongest has a p this small by chance.
  double AmongAll(double p, int name) const {
    if (IsScannedLine(at(name).request)) return tester_.ScanChance(p);
    return std::min(1.0, p * static_cast<double>(tester_.names().size()));
  }

  /// The members that chance does not explain, the surest first. Of thousands of orders and
  /// instants some always resemble, on few poses, a strong cause that has no name: where something
  /// stays unexplained it is the noise that a name must stand out from, one pose one draw of it.
  std::vector<int> BeyondChance(std::vector<int> members) const {
    const int coordinates = space_->rows().coordinates();
    std::vector<int> sure;
    while (!members.empty()) {
      std::vector<double> chances =
          tester_.tests().Chances(tester_.Model(sure), members, coordinates);
      for (std::size_t i = 0; i < members.size(); ++i) {
        chances[i] = AmongAll(chances[i], members[i]);
      }
      const auto least = std::min_element(chances.begin(), chances.end());
      if (*least > options_.false_alarm) break;
      const auto i = static_cast<std::size_t>(least - chances.begin());
      sure.push_back(members[i]);
      members = Without(members, i);
    }
    return sure;
  }

  /// Anonymous blocks that describe what the names leave.
  void DescribeRest(SearchOutcome* out) const {
    const BlockTests& tests = tester_.tests();
    if (!out->complete) out->accepted = BeyondChance(out->accepted);
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
        if (curve.slot_joint == 0 || curve.slot_joint != at(k).request.joint) continue;
        if (!(curve.driver == at(k).driver) || !curve.driver.is_torque()) continue;
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
  Moves moves_;
};

}  // namespace

SearchOutcome Search(const SearchOptions& options, HypothesisSpace* space) {
  return Searcher(options, space).Run();
}

}  // namespace dhcal
