#include "problems/diagnosis/moves.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace dhcal {
namespace {

constexpr std::size_t kMostSwapsTried = 12;  // candidates per member
constexpr int kLinesOfACurve = 3;
constexpr int kMostExtended = 20;

}  // namespace

std::vector<int> With(std::vector<int> members, int hypothesis) {
  members.push_back(hypothesis);
  return members;
}

std::vector<int> Without(std::vector<int> members, std::size_t position) {
  members.erase(members.begin() + static_cast<long>(position));
  return members;
}

int Moves::CountEffects(const std::vector<int>& members) const {
  std::set<std::pair<std::string, int>> distinct;
  for (const int k : members) distinct.insert({at(k).request.effect, at(k).request.joint});
  return static_cast<int>(distinct.size());
}

std::vector<int> Moves::Pruned(std::vector<int> members) const {
  while (!members.empty()) {
    std::vector<int> best = members;
    double best_evidence = tester_.Evidence(members);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::vector<int> tried = Without(members, i);
      const double evidence = tester_.Evidence(tried);
      if (evidence <= best_evidence) continue;
      best_evidence = evidence;
      best = tried;
    }
    if (best == members) break;
    members = best;
  }
  return members;
}

std::vector<int> Moves::Start() {
  std::vector<int> members;
  for (const EffectRequest& request : options_.start) {
    const int k = tester_.Known(request);
    if (k >= 0 && !tester_.Conflicts(k, members)) members.push_back(k);
  }
  if (!members.empty()) tester_.Rebuild();
  return Pruned(members);
}

std::vector<int> Moves::Candidates(const std::vector<int>& members) const {
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

std::vector<int> Moves::BestAddition(const std::vector<int>& members) const {
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

std::vector<int> Moves::OrALine(const std::vector<int>& members, const std::vector<int>& known) {
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

std::vector<int> Moves::WithCurves(std::vector<int> members) {
  std::map<int, int> lines;
  for (const int k : members) {
    if (IsScannedLine(at(k).request)) ++lines[at(k).request.joint];
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

std::vector<int> Moves::WithSwaps(std::vector<int> members) const {
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

std::vector<int> Moves::WithTheRest(const std::vector<int>& members) {
  tester_.TakeShapesAsStated(true);
  std::vector<int> extended = members;
  while (CountEffects(extended) < kMostExtended) {
    const std::vector<int> more = BestAddition(extended);
    if (more.size() == extended.size()) break;
    extended = more;
  }
  if (extended == members) tester_.TakeShapesAsStated(false);
  return extended;
}

}  // namespace dhcal
