// Residual of what is known of a parameter before any reading.
//
//   r(x) = (x - expected) / sigma, 1 row; x and expected are corrections to the nominal value
#ifndef DHCAL_RESIDUALS_PRIOR_H_
#define DHCAL_RESIDUALS_PRIOR_H_

#include <ceres/sized_cost_function.h>

namespace dhcal {

class PriorResidual final : public ceres::SizedCostFunction<1, 1> {
 public:
  /// `expected` and `sigma` in the parameter's unit, [rad] or [m].
  PriorResidual(double expected, double sigma) : expected_(expected), inverse_sigma_(1 / sigma) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    residuals[0] = (parameters[0][0] - expected_) * inverse_sigma_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = inverse_sigma_;
    return true;
  }

 private:
  double expected_;
  double inverse_sigma_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_PRIOR_H_
