#include "problems/diagnosis/rows/moved_by_joint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Of a reading's squares that its joint's motion explains; a third of three coordinates by chance.
constexpr double kAlongMotion = 0.6;
constexpr double kChanceAlong = 0.23;  // that an error in any direction of space is
constexpr double kOnePlace = 0.02;     // chance of a stretch that is a place at all
constexpr std::size_t kOneVisit = 2;   // readings from one to the next
constexpr std::size_t kFewestVisits = 3;
constexpr std::size_t kFewest = 4, kMost = 60;  // readings of one place

/// Which of the readings that lie off are off along the joint's motion.
std::vector<bool> AlongMotion(const JointAtReadings& joint,
                              const VectorXd& residuals,
                              const std::vector<bool>& off) {
  std::vector<bool> along(off.size(), false);
  const Index m = residuals.size() / std::max<Index>(1, static_cast<Index>(off.size()));
  for (std::size_t k = 0; k < off.size(); ++k) {
    if (!off[k]) continue;
    const auto first = static_cast<Index>(k) * m;
    const auto r = residuals.segment(first, m), c = joint.motion.segment(first, m);
    const double product = c.dot(r);
    along[k] = product * product > kAlongMotion * c.squaredNorm() * r.squaredNorm();
  }
  return along;
}

struct Window {
  std::size_t first = 0, last = 0;  // among the candidates, in order of the joint's places
  double p = 1;
};

/// The range, from one candidate to another, that chance fills so with candidates least. `rank`: of
/// each candidate among all readings. A range begins and ends at a candidate anyway, so only those
/// between them count.
Window LeastLikely(const std::vector<int>& rank, std::size_t readings) {
  Window least;
  const auto candidates = static_cast<double>(rank.size());
  const double rate = candidates / static_cast<double>(readings);
  for (std::size_t first = 0; first < rank.size(); ++first) {
    const std::size_t end = std::min(rank.size(), first + kMost);
    for (std::size_t last = first + kFewest - 1; last < end; ++last) {
      const int between = rank[last] - rank[first] - 1;
      const auto inside = static_cast<double>(last - first - 1);
      const boost::math::binomial chance(between, rate);
      const double p = boost::math::cdf(boost::math::complement(chance, inside - 1));
      if (p < least.p) least = {first, last, p};
    }
  }
  least.p *= candidates * (candidates - 1) / 2;
  return least;
}

/// Readings that follow each other count as one visit of a place: they have all else in common,
/// too.
std::vector<std::size_t> Visits(const std::vector<std::size_t>& readings) {
  std::vector<std::size_t> first;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    if (k == 0 || readings[k] > readings[k - 1] + kOneVisit) first.push_back(readings[k]);
  }
  return first;
}

/// How likely it is that so many readings anywhere in a joint's range, of `all`, lie within a
/// stretch of `within` neighbours of it: the lowest of them is anywhere, the others are behind it.
double ChanceOfAStretch(std::size_t visits, std::size_t within, std::size_t all) {
  const auto k = static_cast<double>(visits), m = static_cast<double>(within),
             n = static_cast<double>(all);
  const double log_chance = std::lgamma(m) - std::lgamma(m - k + 1) + std::log(k) +
                            std::log(n - m + m / k) - std::lgamma(n + 1) + std::lgamma(n - k + 1);
  return std::min(1.0, std::exp(log_chance));
}

/// True where all that lies off is off along the joint's motion, at one of its places: few
/// readings, but none that is elsewhere.
bool AllAtOnePlace(const JointAtReadings& joint,
                   const std::vector<bool>& along,
                   const std::vector<bool>& off,
                   double joints) {
  // Of one number all errors are along every motion.
  const double chance_along = joint.motion.size() > joint.place.size() ? kChanceAlong : 1;
  std::vector<std::size_t> readings;
  for (std::size_t k = 0; k < off.size(); ++k) {
    if (off[k] && !along[k]) return false;
    if (off[k]) readings.push_back(k);
  }
  const std::vector<std::size_t> visits = Visits(readings);
  if (visits.size() < kFewestVisits) return false;
  const VectorXd own = joint.place(readings);
  const double low = own.minCoeff(), high = own.maxCoeff();
  const auto within = std::count_if(
      joint.place.begin(), joint.place.end(), [&](double q) { return q >= low && q <= high; });
  const double chance =
      ChanceOfAStretch(visits.size(), static_cast<std::size_t>(within), off.size());
  return chance < kOnePlace &&
         joints * chance * std::pow(chance_along, static_cast<double>(visits.size())) <
             kChanceOfAPlace;
}

/// Marks the readings of all such places of one joint.
void MarkPlaces(const std::vector<JointAtReadings>& joints,
                int joint,
                std::vector<bool> along,
                std::vector<int>* moved) {
  const VectorXd& place = joints[static_cast<std::size_t>(joint)].place;
  std::vector<std::size_t> order(along.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place[static_cast<Index>(a)] < place[static_cast<Index>(b)];
  });
  while (true) {
    std::vector<int> rank;
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (along[order[k]]) rank.push_back(static_cast<int>(k));
    }
    if (rank.size() < kFewest) return;
    const Window window = LeastLikely(rank, order.size());
    if (!(static_cast<double>(joints.size()) * window.p < kChanceOfAPlace)) return;
    for (std::size_t k = window.first; k <= window.last; ++k) {
      const std::size_t reading = order[static_cast<std::size_t>(rank[k])];
      (*moved)[reading] = joint;
      along[reading] = false;
    }
  }
}

}  // namespace

std::vector<int> MovedByAJoint(const std::vector<JointAtReadings>& joints,
                               const VectorXd& residuals,
                               const std::vector<bool>& off) {
  std::vector<int> moved(off.size(), -1);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::vector<bool> along = AlongMotion(joints[k], residuals, off);
    if (AllAtOnePlace(joints[k], along, off, static_cast<double>(joints.size()))) {
      for (std::size_t i = 0; i < off.size(); ++i) {
        if (off[i]) moved[i] = static_cast<int>(k);
      }
      return moved;
    }
    MarkPlaces(joints, static_cast<int>(k), along, &moved);
  }
  return moved;
}

}  // namespace dhcal
