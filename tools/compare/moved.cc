#include "tools/compare/moved.h"

#include <algorithm>
#include <cmath>

namespace dhcal {
namespace {

const ReadParameter* Find(const std::vector<ReadParameter>& all, const std::string& name) {
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const ReadParameter& entry) { return entry.name == name; });
  return found == all.end() ? nullptr : &*found;
}

/// Variance of the logarithm of an RMS error.
double VarianceOfLog(const ReadResult& result) {
  const int numbers = (result.in_space ? 3 : 1) * result.unseen_rows;
  return 1.0 / (2.0 * std::max(numbers, 1));
}

}  // namespace

Moved MovedBetween(const ReadResult& a, const ReadResult& b) {
  Moved moved;
  for (const ReadParameter& of_a : a.parameters) {
    const ReadParameter* const of_b = Find(b.parameters, of_a.name);
    const double sigma = of_b == nullptr ? kNotSet : std::hypot(of_a.sigma, of_b->sigma);
    if (of_b == nullptr) {
      moved.only_a.push_back(of_a.name);
    } else if (of_a.determined && of_b->determined && sigma > 0) {
      moved.determined.push_back({of_a.name, of_a.unit, of_a.value, of_b->value, sigma});
    } else {
      moved.open.push_back(of_a.name);
    }
  }
  for (const ReadParameter& of_b : b.parameters) {
    if (Find(a.parameters, of_b.name) == nullptr) moved.only_b.push_back(of_b.name);
  }
  std::stable_sort(moved.determined.begin(),
                   moved.determined.end(),
                   [](const PairedParameter& left, const PairedParameter& right) {
                     return std::abs(left.sigmas()) > std::abs(right.sigmas());
                   });
  return moved;
}

Better BetterOnUnseenRows(const ReadResult& a, const ReadResult& b) {
  if (std::isnan(a.unseen) || std::isnan(b.unseen) || a.in_space != b.in_space) {
    return Better::kNotKnown;
  }
  if (a.unseen == b.unseen) return Better::kAlike;
  const double distance = std::log(b.unseen / a.unseen);
  const double sigma = std::sqrt(VarianceOfLog(a) + VarianceOfLog(b));
  if (std::abs(distance) <= 2 * sigma) return Better::kAlike;
  return distance < 0 ? Better::kB : Better::kA;
}

}  // namespace dhcal
