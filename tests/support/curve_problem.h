// A small curved least-squares problem with a null direction, for tests of the solvers.
#ifndef DHCAL_TESTS_SUPPORT_CURVE_PROBLEM_H_
#define DHCAL_TESTS_SUPPORT_CURVE_PROBLEM_H_

#include <memory>
#include <vector>

#include <ceres/sized_cost_function.h>

#include "core/solver/estimation_problem.h"

namespace dhcal {

/// r = a + b x + c x^2 + curvature a^2 - y, whitened by sigma: three unknowns a, b, c.
class CurveResidual : public ceres::SizedCostFunction<1, 3> {
 public:
  CurveResidual(double x, double y, double sigma, double curvature)
      : x_(x), y_(y), sigma_(sigma), curvature_(curvature) {}

  bool Evaluate(double const* const* p, double* residual, double** jacobians) const override {
    const double a = p[0][0];
    residual[0] = (a + p[0][1] * x_ + p[0][2] * x_ * x_ + curvature_ * a * a - y_) / sigma_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const double derivatives[] = {1 + 2 * curvature_ * a, x_, x_ * x_};
    for (int k = 0; k < 3; ++k) jacobians[0][k] = derivatives[k] / sigma_;
    return true;
  }

 private:
  double x_, y_, sigma_, curvature_;
};

struct CurveCase {
  std::vector<double> x = {-1, -0.5, 0, 0.5, 1};
  double a = 0.1, b = -0.2, c = 0.3;  // truth
  double sigma = 1e-3;
  double curvature = 0.5;
  double noise_step = 0;  // added with alternating sign to y
  double limit = 1.0;
};

inline std::unique_ptr<EstimationProblem> MakeCurveProblem(const CurveCase& curve) {
  auto problem = std::make_unique<EstimationProblem>(3);
  problem->scales = {Eigen::VectorXd::Ones(3), Eigen::VectorXd::Constant(3, curve.limit)};
  problem->kappa_unit = curve.sigma;
  double sign = 1;
  for (const double x : curve.x) {
    const double y = curve.a + curve.b * x + curve.c * x * x + curve.curvature * curve.a * curve.a +
                     sign * curve.noise_step;
    sign = -sign;
    problem->AddReading(std::make_unique<CurveResidual>(x, y, curve.sigma, curve.curvature),
                        nullptr);
  }
  return problem;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_CURVE_PROBLEM_H_
