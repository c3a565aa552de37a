// Numerical derivatives that find their own step.
#ifndef DHCAL_TESTS_SUPPORT_RIDDERS_H_
#define DHCAL_TESTS_SUPPORT_RIDDERS_H_

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace dhcal {

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// d f / d x_k at x by Ridders' method (Advances in Engineering Software 4, 1982): central
/// differences with steps shrinking by 1.6 from `first_step`, extrapolated to step zero; each entry
/// keeps the value whose own error estimate is the smallest.
inline Eigen::VectorXd RiddersColumn(const VectorFunction& f,
                                     const Eigen::VectorXd& x,
                                     Eigen::Index k,
                                     double first_step) {
  constexpr int kSteps = 10;
  constexpr double kShrink = 1.6;
  const auto central = [&](double step) -> Eigen::VectorXd {
    Eigen::VectorXd above = x, below = x;
    above[k] += step;
    below[k] -= step;
    const Eigen::VectorXd difference = f(above) - f(below);
    return difference / (above[k] - below[k]);
  };
  double step = first_step;
  std::vector<Eigen::VectorXd> row{central(step)};  // of Neville's tableau
  Eigen::VectorXd best = row[0];
  Eigen::ArrayXd smallest = Eigen::ArrayXd::Constant(best.size(), HUGE_VAL);
  for (int i = 1; i < kSteps; ++i) {
    step /= kShrink;
    std::vector<Eigen::VectorXd> next{central(step)};
    double factor = 1.0;
    for (int j = 1; j <= i; ++j) {
      const std::size_t at = static_cast<std::size_t>(j);
      factor *= kShrink * kShrink;
      next.push_back(next[at - 1] + (next[at - 1] - row[at - 1]) / (factor - 1.0));
      const Eigen::ArrayXd error =
          (next[at] - next[at - 1]).array().abs().max((next[at] - row[at - 1]).array().abs());
      best = (error < smallest).select(next[at], best);
      smallest = smallest.min(error);
    }
    row = std::move(next);
  }
  return best;
}

/// All columns. `first_step` should be a tenth or so of the range over which f bends.
inline Eigen::MatrixXd RiddersJacobian(const VectorFunction& f,
                                       const Eigen::VectorXd& x,
                                       double first_step = 0.02) {
  Eigen::MatrixXd J(f(x).size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) J.col(k) = RiddersColumn(f, x, k, first_step);
  return J;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_RIDDERS_H_
