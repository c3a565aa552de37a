#include "core/math/nonuniform_fourier.h"

#include <cmath>
#include <complex>

#include <glog/logging.h>
#include <unsupported/Eigen/FFT>

#include "core/base/units.h"

namespace dhcal {

using Eigen::Index;

NonuniformFourier::NonuniformFourier(const Eigen::VectorXd& points, int count)
    : count_(count), spread_(2 * kReach, points.size()), unspread_(count) {
  CHECK_GT(count, 0);
  // At least twice the 2 count - 1 frequencies from -(count - 1) on.
  for (grid_ = 32; grid_ < 4 * Index{count};) grid_ *= 2;
  const double modes = static_cast<double>(grid_) / 2;
  const double width = kPi * kReach / (modes * modes * 2 * (2 - 0.5));  // tau of the paper
  const double step = 2 * kPi / static_cast<double>(grid_);
  for (Index i = 0; i < points.size(); ++i) {
    const double turn = 2 * kPi * std::floor(points[i] / (2 * kPi));
    const double x = points[i] - turn;
    const auto below = static_cast<Index>(std::floor(x / step));
    first_.push_back(below - kReach + 1);
    for (int k = 0; k < 2 * kReach; ++k) {
      const double apart = x - static_cast<double>(first_.back() + k) * step;
      spread_(k, i) = std::exp(-apart * apart / (4 * width));
    }
  }
  for (int k = 0; k < count; ++k) {
    unspread_[k] = std::sqrt(kPi / width) * std::exp(k * k * width) / static_cast<double>(grid_);
  }
}

Eigen::ArrayXcd NonuniformFourier::Sums(const Eigen::VectorXd& weights) const {
  CHECK_EQ(weights.size(), spread_.cols());
  std::vector<double> grid(static_cast<std::size_t>(grid_), 0.0);
  const Index mask = grid_ - 1;
  for (Index i = 0; i < weights.size(); ++i) {
    const Index first = first_[static_cast<std::size_t>(i)];
    for (int k = 0; k < 2 * kReach; ++k) {
      grid[static_cast<std::size_t>((first + k) & mask)] += weights[i] * spread_(k, i);
    }
  }
  thread_local Eigen::FFT<double> fft;  // keeps its tables
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, grid);
  Eigen::ArrayXcd sums(count_);
  // The FFT turns the other way round: conjugate.
  for (int k = 0; k < count_; ++k) {
    sums[k] = unspread_[k] * std::conj(spectrum[static_cast<std::size_t>(k)]);
  }
  return sums;
}

}  // namespace dhcal
