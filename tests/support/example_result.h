// A result as a calibration of the KR 15 might give it, made by hand: numbers that look real and
// are the same everywhere.
#ifndef DHCAL_TESTS_SUPPORT_EXAMPLE_RESULT_H_
#define DHCAL_TESTS_SUPPORT_EXAMPLE_RESULT_H_

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"
#include "residuals/registry.h"

namespace dhcal {

inline RobotModel ExampleRobot() {
  RobotModel robot;
  robot.name = "KUKA KR 15/2";
  const double d[] = {0.675, 0, 0, -0.6, 0, -0.14};
  const double a[] = {0.3, 0.65, 0.155, 0, 0, 0};
  const double alpha[] = {90, 0, 90, -90, 90, 180};
  for (int i = 0; i < 6; ++i) {
    JointRow row;
    row.name = "A" + std::to_string(i + 1);
    row.theta = i == 2 ? -90 * kDegree : 0;
    row.d = d[i];
    row.a = a[i];
    row.alpha = alpha[i] * kDegree;
    robot.joints.push_back(row);
  }
  robot.X_TQ.translation() = Eigen::Vector3d(0, 0, 0.2);
  return robot;
}

inline ProblemSpec ExampleSpec() {
  ProblemSpec spec;
  spec.file = "cases/kr15.yaml";
  spec.name = "kr15";
  spec.robot = ExampleRobot();
  spec.measurement.kind = KindNamed("position");
  spec.measurement.sigma = 2e-5;
  spec.recording = "cases/kr15.csv";
  spec.solver.method = SolverMethod::kBoth;
  return spec;
}

/// Two runs, the second rows of each unseen.
inline Recording ExampleRecording(int num_rows = 12) {
  Recording recording;
  recording.file = "kr15.csv";
  recording.q = Eigen::MatrixXd(num_rows, 6);
  recording.p_WQ = Eigen::MatrixXd(num_rows, 3);
  recording.run_names = {"morning", "evening"};
  for (int i = 0; i < num_rows; ++i) {
    for (int j = 0; j < 6; ++j) recording.q(i, j) = std::sin(1.7 * i + j) / 3;
    for (int k = 0; k < 3; ++k) recording.p_WQ(i, k) = 1 + std::cos(0.9 * i + k) / 7;
    recording.run_idx.push_back(i < num_rows / 2 ? 0 : 1);
    recording.is_test.push_back(i % 6 == 1);
  }
  return recording;
}

inline ParameterResult ExampleParameter(const std::string& name, Unit unit, int idx) {
  ParameterResult parameter;
  parameter.name = name;
  parameter.unit = unit;
  parameter.nominal = unit == Unit::kRadian ? (idx % 3 - 1) * kPi / 2 : 0.155 * (idx % 4);
  parameter.correction = (unit == Unit::kRadian ? 9e-4 : 1.2e-4) * std::sin(2.0 + 3.0 * idx);
  parameter.value = parameter.nominal + parameter.correction;
  parameter.sigma = (unit == Unit::kRadian ? 1.3e-5 : 8.7e-6) * (1 + idx % 5);
  parameter.ci95_low = parameter.value - 1.96 * parameter.sigma;
  parameter.ci95_high = parameter.value + 1.96 * parameter.sigma;
  parameter.verdict = Verdict::kIdentified;
  return parameter;
}

inline void Doubt(Verdict verdict,
                  std::vector<std::string> partners,
                  const std::string& explanation,
                  ParameterResult* parameter) {
  parameter->verdict = verdict;
  parameter->confounded_with = std::move(partners);
  parameter->explanation = explanation;
  parameter->sigma = 3e-4;
  parameter->ci95_low = parameter->value - 1.96 * parameter->sigma;
  parameter->ci95_high = parameter->value + 1.96 * parameter->sigma;
}

/// theta, alpha, a, d of six joints; d2 and d3 confounded, theta6 unobservable, a5 weak, alpha6
/// fixed.
inline std::vector<ParameterResult> ExampleParameters() {
  std::vector<ParameterResult> parameters;
  for (const auto& [group, unit] : {std::pair("theta", Unit::kRadian),
                                    std::pair("alpha", Unit::kRadian),
                                    std::pair("a", Unit::kMetre),
                                    std::pair("d", Unit::kMetre)}) {
    for (int joint = 1; joint <= 6; ++joint) {
      const int idx = static_cast<int>(parameters.size());
      parameters.push_back(ExampleParameter(group + std::to_string(joint), unit, idx));
    }
  }
  Doubt(Verdict::kUnobservable,
        {},
        "The measured point lies on this axis, so no reading sees it.",
        &parameters[5]);
  Doubt(Verdict::kConfounded,
        {"d3"},
        "Axes 2 and 3 are parallel: only d2 + d3 is determined.",
        &parameters[19]);
  Doubt(Verdict::kConfounded,
        {"d2"},
        "Axes 2 and 3 are parallel: only d2 + d3 is determined.",
        &parameters[20]);
  Doubt(Verdict::kWeak,
        {},
        "Its uncertainty is a third of what manufacture leaves open.",
        &parameters[16]);
  ParameterResult& fixed = parameters[11];
  fixed.verdict = Verdict::kFixed;
  fixed.sigma = fixed.ci95_low = fixed.ci95_high = kNotSet;
  fixed.correction = 0;
  fixed.value = fixed.nominal;
  return parameters;
}

inline FitResult ExampleFit(SolverMethod solver) {
  FitResult fit;
  fit.solver = solver;
  fit.termination = Termination::kSmallChange;
  fit.message =
      "Step 2.1e-09 and relative cost change 3.4e-13 are below their tolerances 1e-08 "
      "and 1e-10.";
  fit.usable = fit.converged = true;
  fit.iterations = solver == SolverMethod::kSvdGaussNewton ? 3 : 5;
  fit.rank = 21;
  fit.rank_numerical = 22;
  fit.columns = 23;
  fit.kappa_norm = 1.9e-5;
  fit.cost = 17.25;
  fit.chi2_reduced = 1.04;
  fit.chi2_p = 0.42;
  fit.seconds = 0.0125;
  fit.rms = 2.04e-5;
  fit.rms_point = 3.53e-5;
  fit.max_point = 7.1e-5;
  for (int i = 0; i < 23; ++i) fit.singular_values.push_back(4.2e4 * std::pow(10.0, -0.31 * i));
  fit.singular_values[21] = 2.5e-4;
  fit.singular_values[22] = 3.1e-13;
  fit.singular_values_of = "noise rule: columns in tolerances, rows in noise, cut at 1";
  fit.truncation_cut = 1.0;
  fit.condition_number = 1.5e6;
  fit.observability = {0.41, 2.3e-5, 1.1e-2, 2.4e-4, 9.9e-2};
  for (int i = 1; i <= fit.iterations; ++i) {
    fit.trace.push_back(
        {i, 17.25 + std::pow(10.0, 4 - 3 * i), 1.9e-5, 21, std::pow(10.0, 2 - 3 * i)});
  }
  fit.parameters = ExampleParameters();
  fit.null_space = {
      {{{"theta6", 1.0}}, "The measured point lies on this axis, so no reading sees it."},
      {{{"d2", 1.0}, {"d3", -1.0}}, "Axes 2 and 3 are parallel: only d2 + d3 is determined."}};
  fit.covariance_check = "Sigmas from ceres::Covariance (SuiteSparse QR) agree to 1.2e-09.";
  fit.covariance_difference = 1.2e-9;
  return fit;
}

inline std::vector<RowResidual> ExampleResiduals(const Recording& recording) {
  std::vector<RowResidual> residuals;
  for (int i = 0; i < recording.num_rows(); ++i) {
    RowResidual row;
    row.row_idx = i;
    row.test = recording.test(i);
    row.measured = recording.p_WQ.row(i).transpose();
    row.predicted_before = row.measured.array() + 1.5e-3;
    row.residual = Eigen::Vector3d(std::sin(i), std::sin(2 * i), std::sin(3 * i)) * 4e-5;
    row.predicted_after = row.measured - row.residual;
    row.standardised = row.residual / 2e-5;
    row.length = row.residual.norm();
    row.sigmas = row.standardised.cwiseAbs().maxCoeff();
    if (!row.test) row.leverage = 0.5;
    row.run = recording.run_names[recording.run(i)];
    residuals.push_back(row);
  }
  return residuals;
}

/// Everything present.
inline Result ExampleResult() {
  Result result;
  result.problem = "kr15";
  result.program_version = "0.1.0";
  result.rows = 10;
  result.rows_test = 2;
  result.num_poses = 12;
  result.kind = KindNamed("position");
  result.noise_sigma = 2e-5;
  result.noise_source = "given in the problem file";
  result.fits = {ExampleFit(SolverMethod::kSvdGaussNewton),
                 ExampleFit(SolverMethod::kLevenbergMarquardt)};
  result.best_fit = 0;
  for (const ParameterResult& parameter : result.fits[0].parameters) {
    if (parameter.verdict == Verdict::kFixed) continue;
    const bool null = parameter.verdict == Verdict::kConfounded;
    const double hidden = null ? 4e-5 : 0.0;
    result.comparison.push_back({parameter.name,
                                 parameter.unit,
                                 parameter.correction,
                                 parameter.correction + hidden + 1e-12,
                                 1e-12,
                                 hidden});
  }
  result.nominal = {1.5e-3, 2.6e-3, 4.4e-3};
  result.base_and_tool_only = Baseline{4.1e-4, 7.1e-4, 1.3e-3};
  result.validation = {"set column", 2, 2.04e-5, 2.31e-5, 4.0e-5, 5.2e-5, 2e-5};
  result.coordinate_names = {"x", "y", "z"};
  result.residuals = ExampleResiduals(ExampleRecording());
  result.calibrated = ExampleRobot();
  result.notes = {"The row 7 is an outlier in none of its coordinates."};
  return result;
}

/// Both solvers failed; there is nothing to use.
inline Result DivergedResult() {
  Result result = ExampleResult();
  for (FitResult& fit : result.fits) {
    fit = FitResult();
    fit.termination = Termination::kDiverged;
    fit.message = "The cost grew from 17 to 1.3e+12 in 20 iterations.";
    fit.iterations = 20;
    fit.rank = 24;
    fit.columns = 24;
    for (int i = 1; i <= 20; ++i) fit.trace.push_back({i, std::pow(10.0, i), kNotSet, 24, 1e3});
  }
  result.fits[1].solver = SolverMethod::kLevenbergMarquardt;
  result.best_fit = -1;
  result.comparison.clear();
  result.base_and_tool_only.reset();
  result.validation = ValidationResult();
  result.residuals.clear();
  return result;
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_EXAMPLE_RESULT_H_
