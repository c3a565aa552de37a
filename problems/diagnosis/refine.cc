#include "problems/diagnosis/refine.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <boost/math/tools/minima.hpp>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/spectrum.h"

namespace dhcal {
namespace {

constexpr int kBits = 20;
constexpr std::size_t kMostInstants = 200;
// A time constant is looked for from a fiftieth of the recording's duration to twice it.
constexpr double kShortest = 0.02, kLongest = 2.0;

/// The setting of a request that is refined; null where it has none.
const EffectSetting* RefinedSetting(const EffectRequest& request) {
  const Effect& effect = *FindEffect(request.effect);
  for (const EffectSetting& setting : effect.Describe().settings) {
    if (setting.is_refined() && request.settings.count(setting.name) > 0) return &setting;
  }
  return nullptr;
}

/// Every instant between two rows, thinned to a number.
std::vector<double> Instants(const PhysicsContext& c) {
  std::vector<double> times(c.clock().begin(), c.clock().end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

bool HasScannedSetting(const EffectRequest& request) { return RefinedSetting(request) != nullptr; }

EffectRequest RefineSetting(const HypothesisSpace& space,
                            const EffectRequest& request,
                            const Eigen::MatrixXd& extra) {
  const EffectSetting& scanned = *RefinedSetting(request);
  const std::string& key = scanned.name;
  EffectRequest best = request;
  double most = space.Removes(request, extra);
  const auto consider = [&](double setting) {
    EffectRequest tried = request;
    tried.settings[key] = setting;
    const double removed = space.Removes(tried, extra);
    if (removed > most) {
      most = removed;
      best = tried;
    }
    return removed;
  };
  const auto search_between = [&](double low, double high) {
    const auto found = boost::math::tools::brent_find_minima(
        [&](double logarithm) { return -consider(std::exp(logarithm)); },
        std::log(low),
        std::log(high),
        kBits / 2);
    consider(std::exp(found.first));
  };
  const double at = request.settings.at(key);
  if (scanned.scan == SettingScan::kTimeConstants) {
    const double duration = space.context().duration();
    if (at > 0) search_between(kShortest * duration, kLongest * duration);
    return best;
  }
  if (scanned.scan == SettingScan::kBetweenCandidates) {
    search_between(at / scanned.scan_factor, at * scanned.scan_factor);
    return best;
  }
  // Instants: coarse over all, then every one around the best.
  const std::vector<double> times = Instants(space.context());
  const std::size_t stride = std::max<std::size_t>(1, times.size() / kMostInstants);
  for (std::size_t k = 1; k + 1 < times.size(); k += stride) consider(times[k]);
  if (stride > 1) {
    const auto found = std::lower_bound(times.begin(), times.end(), best.settings.at(key));
    const auto middle = static_cast<std::size_t>(found - times.begin());
    const std::size_t first = middle > stride ? middle - stride : 1;
    for (std::size_t k = first; k < std::min(middle + stride, times.size()); ++k) {
      consider(times[k]);
    }
  }
  return best;
}

double OrderResolution(const PhysicsContext& c, int joint) {
  const Eigen::VectorXd q = c.q(joint);
  return 2 * kPi / std::max(q.maxCoeff() - q.minCoeff(), 1e-6);
}

double RefineOrder(const HypothesisSpace& space,
                   const EffectRequest& request,
                   double order,
                   const Eigen::MatrixXd& extra) {
  const double half = 0.5 * OrderResolution(space.context(), request.joint - 1);
  const auto lost = [&](double candidate) {
    return -space.Removes(Line(request.joint, candidate), extra);
  };
  return boost::math::tools::brent_find_minima(
             lost, std::max(order - half, kLowestOrder), order + half, kBits)
      .first;
}

}  // namespace dhcal
