#include "problems/diagnosis/search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "core/physics/registry.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refine.h"

namespace dhcal {
namespace {

// Signatures are computed at the nominal robot: what is left of a large effect below these shares
// of its size (squared amplitude) is the signature's own error, not another effect.
constexpr double kImmaterial = 0.02 * 0.02;
constexpr double kImmaterialSamePlace = 0.04 * 0.04;
constexpr int kMostAnonymous = 8;
constexpr std::size_t kMostRefined = 4;

double Combine(double p, double q) {
  const double least = std::min(p, q);
  return 1 - (1 - least) * (1 - least);
}

class Searcher {
 public:
  Searcher(const SearchOptions& options, HypothesisSpace* space)
      : options_(options), space_(space), scan_width_(ScanWidth(space->context())) {
    Rebuild();
  }

  SearchOutcome Run() {
    SearchOutcome out;
    out.scores = tests_->Scores({});
    RankBlocks(out.scores);
    const ModelTest geometry = tests_->Test({}, options_.false_alarm);
    out.score_geometry = geometry.T;
    const std::vector<SpectralPeak> peaks = Scan({});
    out.p_geometry = Combine(geometry.p, LeastScan(peaks));
    out.consistent = out.p_geometry > options_.false_alarm;
    out.tested.push_back({{}, out.p_geometry, out.consistent});
    if (out.consistent) return out;
    AddPeaks(peaks);
    AddRefined({});
    Rebuild();
    RankBlocks(tests_->Scores({}));
    TrySingles(&out);
    if (out.accepted.empty()) TrySets(&out);
    DescribeRest(&out);
    out.scores = tests_->Scores({});
    return out;
  }

 private:
  const Hypothesis& at(int idx) const { return space_->all()[static_cast<std::size_t>(idx)]; }

  void Rebuild() {
    tests_ = std::make_unique<BlockTests>(
        space_->Tests(options_.nu, options_.sigma_known, options_.draws, options_.seed));
    names_.clear();
    for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
      if (at(k).named && MayBeNamed(at(k).request.effect)) names_.push_back(k);
    }
  }

  bool MayBeNamed(const std::string& effect) const {
    const auto& wanted = options_.effects;
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), effect) != wanted.end();
  }

  void RankBlocks(const std::vector<BlockScore>& scores) {
    order_.resize(scores.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int a, int b) {
      return scores[static_cast<std::size_t>(a)].z > scores[static_cast<std::size_t>(b)].z;
    });
  }

  /// Orthonormal basis of the members' projected columns.
  Eigen::MatrixXd BasisOf(const std::vector<int>& members) const {
    Eigen::Index columns = 0;
    for (const int k : members) columns += space_->Projected(k).cols();
    Eigen::MatrixXd all(space_->y().size(), columns);
    Eigen::Index at_column = 0;
    for (const int k : members) {
      all.middleCols(at_column, space_->Projected(k).cols()) = space_->Projected(k);
      at_column += space_->Projected(k).cols();
    }
    return OrthonormalBasis(all, 1e-6);
  }

  std::vector<SpectralPeak> Scan(const std::vector<int>& members) const {
    const Eigen::MatrixXd extra = BasisOf(members);
    Eigen::MatrixXd basis(space_->y().size(), space_->U().cols() + extra.cols());
    basis << space_->U(), extra;
    return ScanOrders(space_->context(),
                      space_->rows(),
                      basis,
                      ProjectOff(extra, space_->y()),
                      options_.nu - static_cast<double>(extra.cols()),
                      options_.sigma_known);
  }

  static double LeastScan(const std::vector<SpectralPeak>& peaks) {
    double least = 1;
    for (const SpectralPeak& peak : peaks) least = std::min(least, peak.p_scan);
    return least;
  }

  /// Significant peaks become candidates. True when there is a new one.
  bool AddPeaks(const std::vector<SpectralPeak>& peaks) {
    bool any = false;
    for (const SpectralPeak& peak : peaks) {
      if (peak.p_scan > options_.false_alarm || !MayBeNamed("gear_harmonic")) continue;
      EffectRequest request;
      request.effect = "gear_harmonic";
      request.joint = peak.joint + 1;
      request.settings["order"] = RefineOrder(*space_, request, peak.order);
      lines_.push_back(space_->AddEffect(request, /*in_maximum=*/false));
      any = true;
    }
    return any;
  }

  /// Families with an instant or a time constant that the rows ask for most get the best one.
  void AddRefined(const std::vector<int>& members) {
    const std::vector<BlockScore> scores = tests_->Scores(ModelOf(*space_, *tests_, members));
    std::map<std::string, int> best;  // family -> member with the highest score
    for (const int k : names_) {
      if (!HasScannedSetting(at(k).request)) continue;
      const auto [entry, is_new] = best.try_emplace(at(k).family, k);
      if (!is_new && scores[static_cast<std::size_t>(k)].z >
                         scores[static_cast<std::size_t>(entry->second)].z) {
        entry->second = k;
      }
    }
    std::vector<int> ranked;
    for (const auto& [family, k] : best) ranked.push_back(k);
    std::sort(ranked.begin(), ranked.end(), [&](int a, int b) {
      return scores[static_cast<std::size_t>(a)].z > scores[static_cast<std::size_t>(b)].z;
    });
    const Eigen::MatrixXd extra = BasisOf(members);
    for (std::size_t k = 0; k < ranked.size() && k < kMostRefined; ++k) {
      if (scores[static_cast<std::size_t>(ranked[k])].z < 3) break;
      const EffectRequest refined = RefineSetting(*space_, at(ranked[k]).request, extra);
      if (!refined.SameAs(at(ranked[k]).request)) space_->AddEffect(refined, false);
    }
  }

  /// What a model may leave of each block without being rejected.
  Eigen::VectorXd Excused(const BlockModel& model, const std::vector<int>& members) const {
    const double removed = tests_->Removed(model);
    std::set<std::string> places, classes;
    for (const int k : members) {
      places.insert(at(k).place.location);
      classes.insert(at(k).place.effect_class);
      places.insert("theta" + std::to_string(at(k).request.joint));
    }
    Eigen::VectorXd excused(static_cast<Eigen::Index>(space_->all().size()));
    for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
      const Hypothesis& h = at(k);
      const bool same = h.named ? places.count(h.place.location) > 0 ||
                                      classes.count(h.place.effect_class) > 0
                                : places.count(h.slot) > 0;
      excused[k] = removed * (same ? kImmaterialSamePlace : kImmaterial);
    }
    return excused;
  }

  /// Tests a set of names; a hopeless one at small cost.
  TestedSet Try(const std::vector<int>& members, bool rescan) const {
    const BlockModel model = ModelOf(*space_, *tests_, members);
    const Eigen::VectorXd excused = Excused(model, members);
    TestedSet set;
    set.members = members;
    constexpr double kHopeless = 7.0;  // no maximum of a few hundred normal scores comes near
    if (!tests_->MayFit(model, order_, kHopeless, excused)) return set;
    const double p_lines = LinesLeft(model);
    if (p_lines <= options_.false_alarm / 2) return set;
    set.p = Combine(tests_->Test(model, options_.false_alarm, excused).p, p_lines);
    // A new scan costs much; a model that leaves no known line hardly leaves another.
    if (rescan && set.p > options_.false_alarm) set.p = std::min(set.p, LeastScan(Scan(members)));
    set.kept = set.p > options_.false_alarm;
    return set;
  }

  /// Probability of the highest of the spectrum's known lines beside a model, for the whole scan.
  double LinesLeft(const BlockModel& model) const {
    double least = 1;
    for (const int k : lines_) {
      const BlockScore score = tests_->Score(model, k);
      if (score.k > 0) least = std::min(least, ScanProbability(score.p, scan_width_));
    }
    return least;
  }

  /// Evidence of a set: squares removed against the price of its columns (BIC; larger is better).
  double Evidence(const std::vector<int>& members) const {
    const BlockModel model = ModelOf(*space_, *tests_, members);
    const double n = options_.nu;
    const double removed = tests_->Removed(model);
    const double gain = options_.sigma_known
                            ? removed
                            : -n * std::log(std::max(1 - removed / tests_->gram().rss, 1e-12));
    return gain - static_cast<double>(model.columns.size()) * std::log(n);
  }

  void TrySingles(SearchOutcome* out) {
    std::map<std::string, std::size_t> of_family;
    for (const int k : names_) {
      TestedSet set = Try({k}, /*rescan=*/true);
      // Of one family only the best setting counts: they are one hypothesis.
      const auto [entry, is_new] = of_family.try_emplace(at(k).family, out->tested.size());
      if (is_new) {
        out->tested.push_back(set);
        continue;
      }
      TestedSet& known = out->tested[entry->second];
      const bool better = set.kept != known.kept ? set.kept
                                                 : Evidence(set.members) > Evidence(known.members);
      if (better) known = set;
    }
    Choose(out);
  }

  /// The kept set with the best evidence becomes the answer.
  void Choose(SearchOutcome* out) const {
    double best = -1e300;
    for (const TestedSet& set : out->tested) {
      if (!set.kept || set.members.empty()) continue;
      const double evidence = Evidence(set.members);
      if (evidence <= best) continue;
      best = evidence;
      out->accepted = set.members;
      out->p_accepted = set.p;
      out->complete = true;
    }
  }

  /// Best single addition or exchange by evidence; the members unchanged when none helps.
  std::vector<int> BestAddition(const std::vector<int>& members) const {
    const std::vector<BlockScore> scores = tests_->Scores(ModelOf(*space_, *tests_, members));
    const double count = static_cast<double>(names_.size());
    std::vector<int> best = members;
    double best_evidence = Evidence(members);
    for (const int k : names_) {
      if (Conflicts(k, members)) continue;
      // Its own p, for as many as are tried.
      if (scores[static_cast<std::size_t>(k)].p * count > options_.false_alarm) continue;
      std::vector<int> tried = members;
      tried.push_back(k);
      const double evidence = Evidence(tried);
      if (evidence <= best_evidence) continue;
      best_evidence = evidence;
      best = tried;
    }
    return best;
  }

  /// The same effect at the same place twice (other settings), but for several gear orders.
  bool Conflicts(int k, const std::vector<int>& members) const {
    for (const int m : members) {
      if (m == k) return true;
      const bool same = at(m).request.effect == at(k).request.effect &&
                        at(m).request.joint == at(k).request.joint;
      const bool lines = at(k).request.effect == "gear_harmonic" ||
                         at(k).request.effect == "joint_coupling";
      if (same && (!lines || at(m).request.SameAs(at(k).request))) return true;
      if (same && lines && at(k).request.effect == "gear_harmonic" &&
          std::abs(at(m).request.setting("order", 1) - at(k).request.setting("order", 1)) < 0.3) {
        return true;
      }
    }
    return false;
  }

  std::vector<int> WithSwaps(std::vector<int> members) const {
    for (int round = 0; round < 4; ++round) {
      std::vector<int> best = members;
      double best_evidence = Evidence(members);
      for (std::size_t i = 0; i < members.size(); ++i) {
        std::vector<int> without = members;
        without.erase(without.begin() + static_cast<long>(i));
        if (Evidence(without) > best_evidence) {
          best_evidence = Evidence(without);
          best = without;
        }
        for (const int k : names_) {
          if (Conflicts(k, without)) continue;
          std::vector<int> tried = without;
          tried.push_back(k);
          const double evidence = Evidence(tried);
          if (evidence <= best_evidence) continue;
          best_evidence = evidence;
          best = tried;
        }
      }
      if (best == members) break;
      members = best;
    }
    return members;
  }

  void TrySets(SearchOutcome* out) {
    std::vector<int> members;
    while (static_cast<int>(members.size()) < options_.max_effects) {
      const std::vector<int> more = BestAddition(members);
      if (more.size() == members.size()) {
        // Nothing known helps; a new line of the spectrum or a better instant may.
        const std::size_t before = space_->all().size();
        AddPeaks(Scan(members));
        AddRefined(members);
        if (space_->all().size() == before) break;
        Rebuild();
        if (BestAddition(members).size() == members.size()) break;
        continue;
      }
      members = WithSwaps(more);
      const TestedSet set = Try(members, /*rescan=*/true);
      out->p_accepted = set.p;
      if (!set.kept) continue;
      out->complete = true;
      break;
    }
    out->accepted = members;
    if (members.empty()) return;
    out->tested.push_back({members, out->p_accepted, out->complete});
    if (out->complete) TryExchanges(members, out);
  }

  /// The confidence set over the sets that one exchange reaches.
  void TryExchanges(const std::vector<int>& members, SearchOutcome* out) const {
    for (std::size_t i = 0; i < members.size(); ++i) {
      std::map<std::string, TestedSet> of_family;
      for (const int k : names_) {
        std::vector<int> tried = members;
        tried.erase(tried.begin() + static_cast<long>(i));
        if (Conflicts(k, tried) || k == members[i] || at(k).family == at(members[i]).family) {
          continue;
        }
        tried.push_back(k);
        const TestedSet set = Try(tried, /*rescan=*/false);
        if (set.kept) of_family.emplace(at(k).family, set);
      }
      for (const auto& [family, set] : of_family) out->tested.push_back(set);
    }
  }

  /// Anonymous blocks that describe what the names leave.
  void DescribeRest(SearchOutcome* out) const {
    BlockModel model = ModelOf(*space_, *tests_, out->accepted);
    out->removed_by_names = tests_->Removed(model);
    out->removed_by_all = out->removed_by_names;
    if (out->complete) return;
    const double count = static_cast<double>(space_->all().size());
    while (static_cast<int>(out->anonymous.size()) < kMostAnonymous) {
      const std::vector<BlockScore> scores = tests_->Scores(model);
      int best = -1;
      for (int k = 0; k < static_cast<int>(space_->all().size()); ++k) {
        const BlockScore& score = scores[static_cast<std::size_t>(k)];
        if (at(k).named || !at(k).in_maximum || score.p * count > options_.false_alarm) continue;
        if (best < 0 || score.z > scores[static_cast<std::size_t>(best)].z) best = k;
      }
      if (best < 0) break;
      out->anonymous.push_back(best);
      for (const int column : tests_->Columns(best)) model.columns.push_back(column);
    }
    out->removed_by_all = tests_->Removed(model);
    KeepWhatSurvives(model, out);
  }

  /// A name must survive the best anonymous description of the rest, and the names together must
  /// be the better part of it: else they are a chance likeness, not the cause.
  void KeepWhatSurvives(const BlockModel& with_rest, SearchOutcome* out) const {
    constexpr double kBetterPart = 0.5;
    const double count = static_cast<double>(names_.size());
    std::vector<int> surviving;
    for (const int k : out->accepted) {
      BlockModel without = with_rest;
      const std::vector<int> own = tests_->Columns(k);
      without.columns.erase(
          std::remove_if(without.columns.begin(),
                         without.columns.end(),
                         [&](int c) { return std::find(own.begin(), own.end(), c) != own.end(); }),
          without.columns.end());
      const BlockScore score = tests_->Scores(without)[static_cast<std::size_t>(k)];
      if (score.k > 0 && score.p * count < options_.false_alarm) surviving.push_back(k);
    }
    const double removed = tests_->Removed(ModelOf(*space_, *tests_, surviving));
    if (removed < kBetterPart * out->removed_by_all) surviving.clear();
    out->accepted = surviving;
    out->removed_by_names = surviving.empty() ? 0 : removed;
  }

  const SearchOptions& options_;
  HypothesisSpace* space_;
  std::unique_ptr<BlockTests> tests_;
  std::vector<int> names_;
  std::vector<int> order_;
  std::vector<int> lines_;  // hypotheses that a scan found
  double scan_width_;
};

}  // namespace

BlockModel ModelOf(const HypothesisSpace& space,
                   const BlockTests& tests,
                   const std::vector<int>& members) {
  BlockModel model;
  for (const int k : members) {
    for (const int column : tests.Columns(k)) model.columns.push_back(column);
  }
  std::vector<double> sigma;
  const Eigen::VectorXd estimate = members.empty() ? Eigen::VectorXd() : tests.Estimate(model);
  Eigen::Index first = 0;
  for (const int k : members) {
    const Hypothesis& h = space.all()[static_cast<std::size_t>(k)];
    if (h.shape_block >= 0) {
      for (const int column : tests.Columns(h.shape_block)) {
        model.soft.push_back(column);
        sigma.push_back(std::abs(estimate[first]));
      }
    }
    first += h.columns.size;
  }
  model.soft_sigma =
      Eigen::Map<Eigen::VectorXd>(sigma.data(), static_cast<Eigen::Index>(sigma.size()));
  return model;
}

SearchOutcome Search(const SearchOptions& options, HypothesisSpace* space) {
  return Searcher(options, space).Run();
}

}  // namespace dhcal
