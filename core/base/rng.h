// A seeded random generator whose numbers are the same with every standard library.
#ifndef DHCAL_CORE_BASE_RNG_H_
#define DHCAL_CORE_BASE_RNG_H_

#include <cstdint>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

namespace dhcal {

/// Pass it by reference; a copy repeats the same numbers.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}
  Rng(const Rng&) = delete;
  Rng& operator=(const Rng&) = delete;

  /// Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * uniform_(engine_); }
  /// Standard normal.
  double Normal() { return normal_(engine_); }

 private:
  // Boost's distributions, unlike the standard's, are specified to the bit.
  boost::random::mt19937_64 engine_;
  boost::random::uniform_01<double> uniform_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_RNG_H_
