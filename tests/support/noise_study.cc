#include "tests/support/noise_study.h"

#include <cmath>
#include <vector>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/math/statistics.h"
#include "problems/fit.h"
#include "problems/fit_analysis.h"
#include "problems/noise.h"
#include "problems/simulate.h"
#include "tests/support/independent_kinematics.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

constexpr int kNewPoses = 2000;

Eigen::MatrixXd NewPoses(int num_joints) {
  Rng rng(20040620);
  Eigen::MatrixXd q(kNewPoses, num_joints);
  for (double& angle : q.reshaped()) angle = rng.Uniform(-kPi, kPi);
  return q;
}

std::vector<Eigen::Vector3d> TruePoints(const ProblemSpec& spec, const Eigen::MatrixXd& q) {
  const Eigen::VectorXd truth = ErrorSlots(spec.robot, *spec.simulate);
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    points.push_back(independent::ForwardKinematics<double>(spec.robot, q.row(k).transpose(), truth)
                         .block<3, 1>(0, 3));
  }
  return points;
}

double PredictionError(const Calibration& c,
                       const Eigen::VectorXd& state,
                       const Eigen::MatrixXd& q,
                       const std::vector<Eigen::Vector3d>& truth) {
  const Eigen::VectorXd delta = c.SlotDeltas(state, 0);
  double squares = 0;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    const Eigen::Isometry3d X_WQ =
        c.chain.Pose<double>(q.row(k).transpose(), delta, c.frames.ends(0, 0));
    squares += (X_WQ.translation() - truth[static_cast<std::size_t>(k)]).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(q.rows()));
}

}  // namespace

NoiseStudy RunNoiseStudy(ProblemSpec spec, int draws) {
  const Eigen::MatrixXd q = NewPoses(spec.robot.num_joints());
  const std::vector<Eigen::Vector3d> points = TruePoints(spec, q);
  const Eigen::VectorXd truth = ErrorSlots(spec.robot, *spec.simulate);
  NoiseStudy study;
  int covered = 0;
  std::vector<double> errors;
  for (int draw = 1; draw <= draws; ++draw) {
    spec.simulate->seed = static_cast<std::uint64_t>(draw);
    const Recording recording = RecordingOf(spec);
    const Calibration c(spec, recording);
    const Fit fit = RunFit(
        c, SolverMethod::kSvdGaussNewton, OptionsOf(spec.solver), InitialNoise(c), Progress());
    if (!fit.summary.IsSolutionUsable()) {
      ++study.num_failed;
      continue;
    }
    errors.push_back(PredictionError(c, fit.summary.state, q, points));
    const FitAnalysis analysis = Analyse(c, fit);
    const double quantile = StudentTwoSided(0.95, analysis.degrees_of_freedom);
    for (std::size_t k = 0; k < c.parameters.size(); ++k) {
      if (analysis.identifiability.parameters[k].verdict != Verdict::kIdentified) continue;
      const auto i = static_cast<Eigen::Index>(k);
      const double sigma = std::sqrt(analysis.identifiability.covariance(i, i));
      const double deviation = fit.summary.state[i] - truth[c.parameters[k].slot];
      covered += std::abs(deviation) <= quantile * sigma ? 1 : 0;
      ++study.num_intervals;
    }
  }
  study.coverage = static_cast<double>(covered) / study.num_intervals;
  study.median_prediction = Median(errors);
  return study;
}

}  // namespace dhcal
