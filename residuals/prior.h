// What is known of parameters before any reading.
//
//   r_i(x) = x_k(i) / sigma_i, one row per prior; x_k a correction to the nominal value
#ifndef DHCAL_RESIDUALS_PRIOR_H_
#define DHCAL_RESIDUALS_PRIOR_H_

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

namespace dhcal {

struct Prior {
  int parameter = 0;
  double sigma = 1;  // in the parameter's unit, [rad] or [m]
};

/// All priors as one block of a dense parameter block.
class PriorBlock final : public ceres::CostFunction {
 public:
  PriorBlock(std::vector<Prior> priors, int num_unknowns) : priors_(std::move(priors)) {
    set_num_residuals(static_cast<int>(priors_.size()));
    mutable_parameter_block_sizes()->push_back(num_unknowns);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const bool derivatives = jacobians != nullptr && jacobians[0] != nullptr;
    const int n = parameter_block_sizes()[0];
    if (derivatives) Eigen::Map<Eigen::VectorXd>(jacobians[0], num_residuals() * n).setZero();
    for (std::size_t i = 0; i < priors_.size(); ++i) {
      residuals[i] = parameters[0][priors_[i].parameter] / priors_[i].sigma;
      if (!derivatives) continue;
      jacobians[0][static_cast<int>(i) * n + priors_[i].parameter] = 1 / priors_[i].sigma;
    }
    return true;
  }

 private:
  std::vector<Prior> priors_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_PRIOR_H_
