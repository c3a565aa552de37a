// Fourier sums over irregular points for many equally spaced frequencies at once: Greengard and
// Lee, Accelerating the nonuniform fast Fourier transform, SIAM Review 46 (2004) 443.
#ifndef DHCAL_CORE_MATH_NONUNIFORM_FOURIER_H_
#define DHCAL_CORE_MATH_NONUNIFORM_FOURIER_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

/// F_k = sum_i w_i exp(i k x_i) for k = 0 ... count - 1, to about 1e-6 of sum |w|. The points are
/// prepared once; each set of weights then costs a dozen products per point and one FFT.
class NonuniformFourier {
 public:
  NonuniformFourier(const Eigen::VectorXd& points, int count);

  Eigen::ArrayXcd Sums(const Eigen::VectorXd& weights) const;

 private:
  static constexpr int kReach = 6;  // grid points that a point is spread over, to each side

  int count_;
  Eigen::Index grid_ = 0;            // points of the grid, a power of two
  std::vector<Eigen::Index> first_;  // first grid point of each point's spread
  Eigen::Matrix<double, 2 * kReach, Eigen::Dynamic> spread_;
  Eigen::ArrayXd unspread_;  // per frequency
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_NONUNIFORM_FOURIER_H_
