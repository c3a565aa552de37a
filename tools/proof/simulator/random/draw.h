// Choices by chance.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/base/rng.h"

namespace dhcal::concealed {

bool Chance(double probability, Rng* rng);

/// 0 ... count - 1, all alike.
int DrawInt(int count, Rng* rng);

/// An index with a probability as its weight.
std::size_t DrawIndex(const std::vector<double>& weights, Rng* rng);

double DrawLogUniform(double low, double high, Rng* rng);

/// A direction in space, all alike.
Eigen::Vector3d DrawDirection(Rng* rng);

/// An angle of a full turn, and 1 or -1.
double DrawPhase(Rng* rng);
double DrawSign(Rng* rng);

/// One of several different values that is not `than`.
int DrawOther(const std::vector<int>& values, int than, Rng* rng);

struct Weighted {
  double value = 0, weight = 0;
};
double DrawValue(const std::vector<Weighted>& values, Rng* rng);

template <typename T>
const T& DrawFrom(const std::vector<T>& values, Rng* rng) {
  return values[static_cast<std::size_t>(DrawInt(static_cast<int>(values.size()), rng))];
}

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_DRAW_H_
