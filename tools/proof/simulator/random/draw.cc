#include "tools/proof/simulator/random/draw.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/units.h"

namespace dhcal::concealed {

bool Chance(double probability, Rng* rng) { return rng->Uniform(0, 1) < probability; }

int DrawInt(int count, Rng* rng) {
  return std::min(static_cast<int>(rng->Uniform(0, count)), count - 1);
}

std::size_t DrawIndex(const std::vector<double>& weights, Rng* rng) {
  double left = rng->Uniform(0, std::accumulate(weights.begin(), weights.end(), 0.0));
  for (std::size_t k = 0; k + 1 < weights.size(); ++k) {
    left -= weights[k];
    if (left < 0) return k;
  }
  return weights.size() - 1;
}

double DrawLogUniform(double low, double high, Rng* rng) {
  return std::exp(rng->Uniform(std::log(low), std::log(high)));
}

Eigen::Vector3d DrawDirection(Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return Eigen::Vector3d(x, y, z).normalized();
}

double DrawPhase(Rng* rng) { return rng->Uniform(-kPi, kPi); }

double DrawSign(Rng* rng) { return Chance(0.5, rng) ? 1 : -1; }

int DrawOther(const std::vector<int>& values, int than, Rng* rng) {
  int other = than;
  while (other == than) other = DrawFrom(values, rng);
  return other;
}

double DrawValue(const std::vector<Weighted>& values, Rng* rng) {
  std::vector<double> weights;
  for (const Weighted& value : values) weights.push_back(value.weight);
  return values[DrawIndex(weights, rng)].value;
}

}  // namespace dhcal::concealed
