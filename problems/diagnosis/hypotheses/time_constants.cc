#include "problems/diagnosis/hypotheses/time_constants.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <boost/math/tools/minima.hpp>

#include "problems/diagnosis/hypotheses/library.h"

namespace dhcal {
namespace {

constexpr char kConstant[] = "time_constant_s";
constexpr std::size_t kDriftsRefined = 3;
constexpr double kNeighbour = 1.7;     // the grid's steps are smaller
constexpr int kBitsOfConstant = 8;     // of the logarithm's range
constexpr double kWorthRefining = 25;  // squares: below, no grid is too coarse
constexpr double kBetterBy = 4;        // squares that a time constant of its own is worth

bool HasConstant(const Item& item) { return item.request.settings.count(kConstant) > 0; }

EffectRequest WithConstant(EffectRequest request, double seconds) {
  const double digit = std::pow(10.0, std::floor(std::log10(seconds)) - 2);
  request.settings[kConstant] = std::round(seconds / digit) * digit;
  return request;
}

/// The best form of each drift, those that remove most first.
std::vector<int> BestForms(const Bank& bank, const Eigen::VectorXd& gains) {
  std::map<std::string, int> best;
  for (std::size_t i = 0; i < bank.items().size(); ++i) {
    if (!HasConstant(bank.items()[i])) continue;
    const auto k = static_cast<int>(i);
    const auto at = best.try_emplace(bank.items()[i].id, k).first;
    if (gains[k] > gains[at->second]) at->second = k;
  }
  std::vector<int> forms;
  for (const auto& [id, k] : best) {
    if (gains[k] > kWorthRefining) forms.push_back(k);
  }
  std::sort(forms.begin(), forms.end(), [&](int a, int b) {
    return gains[a] != gains[b] ? gains[a] > gains[b] : a < b;
  });
  if (forms.size() > kDriftsRefined) forms.resize(kDriftsRefined);
  return forms;
}

}  // namespace

void AddTimeConstants(const PhysicsContext& context, Bank* bank) {
  if (!context.has_time() || !(context.duration() > 0)) return;
  std::vector<int> others;
  for (const int k : bank->members()) {
    if (!HasConstant(bank->items()[static_cast<std::size_t>(k)])) others.push_back(k);
  }
  const Bank::Rest rest = bank->RestBeside(others);
  const Eigen::VectorXd gains = bank->Gains(others);
  for (const int form : BestForms(*bank, gains)) {
    const Item coarse = bank->items()[static_cast<std::size_t>(form)];
    const double now = coarse.request.settings.at(kConstant);
    if (!(now > 0)) continue;  // steady is as simple as can be
    const auto item_at = [&](double log_seconds) {
      return NamedItem(
          context, WithConstant(coarse.request, std::exp(log_seconds)), coarse.variants);
    };
    const auto [log_best, least] = boost::math::tools::brent_find_minima(
        [&](double log_seconds) { return -bank->GainBeside(rest, item_at(log_seconds)); },
        std::log(now / kNeighbour),
        std::log(now * kNeighbour),
        kBitsOfConstant);
    if (-least < gains[form] + kBetterBy) continue;
    Item fine = item_at(log_best);
    const bool known = std::any_of(bank->items().begin(),
                                   bank->items().end(),
                                   [&](const Item& other) { return other.SameAs(fine); });
    if (!known) bank->Add(std::move(fine));
  }
}

}  // namespace dhcal
