#include "core/math/slow_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Where the likelihood is looked up; it is flat between.
constexpr std::array<double, 11> kShares = {
    0.03, 0.06, 0.1, 0.15, 0.22, 0.3, 0.4, 0.55, 0.7, 0.85, 1.0};
constexpr std::array<double, 12> kPersistences = {
    0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.88, 0.94, 0.97, 0.985};
constexpr double kClearlyLikelier = 4;

}  // namespace

SlowNoiseFilter::SlowNoiseFilter(const SlowNoise& noise, const ReadingOrder& order)
    : coordinates_(order.coordinates) {
  const Index n = order.num_readings();
  scale_.resize(n);
  keep_ = VectorXd::Zero(n);
  take_ = VectorXd::Zero(n);
  double variance = noise.share;  // of the wandering part, before the reading
  for (Index t = 0; t < n; ++t) {
    const double innovation = variance + 1 - noise.share;
    scale_[t] = 1 / std::sqrt(innovation);
    log_determinant_ += std::log(innovation);
    const auto at = static_cast<std::size_t>(t);
    if (t + 1 == n || order.sequence[at + 1] != order.sequence[at]) {
      variance = noise.share;
      continue;
    }
    const double decay = std::pow(noise.persistence, order.place[at + 1] - order.place[at]);
    const double gain = variance / innovation;
    keep_[t] = decay * (1 - gain);
    take_[t] = decay * gain;
    variance = decay * decay * variance * (1 - gain) + noise.share * (1 - decay * decay);
  }
}

void SlowNoiseFilter::Whiten(Eigen::Ref<VectorXd> v) const {
  for (int coordinate = 0; coordinate < coordinates_; ++coordinate) {
    double wandered = 0;
    for (Index t = 0; t < scale_.size(); ++t) {
      double& value = v[t * coordinates_ + coordinate];
      const double read = value;
      value = scale_[t] * (read - wandered);
      wandered = keep_[t] * wandered + take_[t] * read;
    }
  }
}

void SlowNoiseFilter::WhitenAdjoint(Eigen::Ref<VectorXd> v) const {
  for (int coordinate = 0; coordinate < coordinates_; ++coordinate) {
    double wandered = 0;
    for (Index t = scale_.size() - 1; t >= 0; --t) {
      double& value = v[t * coordinates_ + coordinate];
      const double scaled = scale_[t] * value;
      value = scaled + take_[t] * wandered;
      wandered = keep_[t] * wandered - scaled;
    }
  }
}

SlowNoiseFilter::Precision SlowNoiseFilter::PrecisionOf() const {
  const Index n = scale_.size();
  Precision precision{VectorXd::Zero(n), VectorXd::Zero(n)};
  // What a unit of the wandering part at t does to the squares of all innovations from t on.
  double later = 0;
  for (Index t = n - 1; t >= 0; --t) {
    const double square = scale_[t] * scale_[t];
    precision.own[t] = square + take_[t] * take_[t] * later;
    if (t > 0) {
      precision.with_before[t] = take_[t - 1] * (take_[t] * keep_[t] * later - square);
    }
    later = square + keep_[t] * keep_[t] * later;
  }
  return precision;
}

LikeliestSlowNoise FindSlowNoise(const VectorXd& values,
                                 const ReadingOrder& order,
                                 const SlowNoise& known) {
  const double white = values.squaredNorm();
  if (!(white > 0)) return {};
  const auto evidence_of = [&](const SlowNoise& noise) {
    const SlowNoiseFilter filter(noise, order);
    VectorXd innovations = values;
    filter.Whiten(innovations);
    return -static_cast<double>(values.size()) * std::log(innovations.squaredNorm() / white) -
           order.coordinates * filter.log_determinant();
  };
  LikeliestSlowNoise best;
  for (const double share : kShares) {
    for (const double persistence : kPersistences) {
      const SlowNoise noise{share, persistence};
      const double evidence = evidence_of(noise);
      if (evidence > best.evidence) best = {noise, evidence};
    }
  }
  if (known.none()) return best;
  const double of_known = evidence_of(known);
  return best.evidence > of_known + kClearlyLikelier ? best : LikeliestSlowNoise{known, of_known};
}

}  // namespace dhcal
