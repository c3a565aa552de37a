// Readings one after the other with white noise and, beside it, a part that wanders: an instrument
// that warms up, air that moves, a floor that settles. The two add up to unit variance.
#ifndef DHCAL_CORE_MATH_SLOW_NOISE_H_
#define DHCAL_CORE_MATH_SLOW_NOISE_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

struct SlowNoise {
  double share = 0;        // of the variance that wanders; 1 = an AR(1) process
  double persistence = 0;  // of it, from a reading to the next

  bool operator!=(const SlowNoise& other) const {
    return share != other.share || persistence != other.persistence;
  }
  bool none() const { return share <= 0 || persistence <= 0; }
  /// Of neighbouring readings.
  double correlation() const { return share * persistence; }
};

/// Where readings stand: `place` counts on within a sequence and may have gaps.
struct ReadingOrder {
  std::vector<int> sequence, place;
  int coordinates = 1;  // of a reading, each with noise of its own

  int num_readings() const { return static_cast<int>(place.size()); }
};

/// The linear operator W that makes such noise white: the innovations of the Kalman filter of the
/// wandering part, each over its standard deviation (Kalman 1960; Harvey 1989, 3.4). O(n).
class SlowNoiseFilter {
 public:
  SlowNoiseFilter(const SlowNoise& noise, const ReadingOrder& order);

  /// v = W v, of values reading by reading, coordinate by coordinate.
  void Whiten(Eigen::Ref<Eigen::VectorXd> v) const;
  /// v = W' v.
  void WhitenAdjoint(Eigen::Ref<Eigen::VectorXd> v) const;

  /// Diagonal of W' W, per reading, and its first off-diagonal: with the reading before (0 where a
  /// sequence begins).
  struct Precision {
    Eigen::VectorXd own, with_before;
  };
  Precision PrecisionOf() const;

  /// Sum of the logarithms of the innovations' variances, per coordinate.
  double log_determinant() const { return log_determinant_; }

 private:
  int coordinates_;
  // Of reading t: 1 / standard deviation of its innovation; a(t + 1) = keep a(t) + take v(t).
  Eigen::VectorXd scale_, keep_, take_;
  double log_determinant_ = 0;
};

struct LikeliestSlowNoise {
  SlowNoise noise;
  double evidence = 0;  // twice the logarithm of how much likelier it is than white noise
};
/// The likeliest slow noise of values (reading by reading) of unknown variance; none where nothing
/// is likelier. `known` stays where nothing is clearly likelier.
LikeliestSlowNoise FindSlowNoise(const Eigen::VectorXd& values,
                                 const ReadingOrder& order,
                                 const SlowNoise& known = {});

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_SLOW_NOISE_H_
