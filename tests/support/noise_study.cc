#include "tests/support/noise_study.h"

#include <cmath>
#include <optional>
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

struct Range {
  double low, high;  // [deg]
};

/// KUKA KR 15/2, data sheet: A1 +-185, A2 -55 to 115 and A3 -210 to 70 from the home position,
/// A4 +-350, A5 +-135, A6 +-350; here as DH angles, which run against the controller's at A2 and A3
/// and are 90 deg at home for A2.
constexpr Range kJointRanges[] = {
    {-185, 185}, {90 - 115, 90 + 55}, {-70, 210}, {-350, 350}, {-135, 135}, {-350, 350}};
constexpr Range kFullTurns[] = {
    {-180, 180}, {-180, 180}, {-180, 180}, {-180, 180}, {-180, 180}, {-180, 180}};

Eigen::MatrixXd NewPoses(const Range (&ranges)[6]) {
  Rng rng(20040620);
  Eigen::MatrixXd q(kNewPoses, 6);
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    for (double& angle : q.col(j)) {
      angle = rng.Uniform(ranges[j].low * kDegree, ranges[j].high * kDegree);
    }
  }
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

/// Poses at which nothing was fitted, and where the true robot is there.
struct NewPlaces {
  NewPlaces(const ProblemSpec& spec, const Range (&ranges)[6])
      : q(NewPoses(ranges)), points(TruePoints(spec, q)) {}
  Eigen::MatrixXd q;
  std::vector<Eigen::Vector3d> points;
};

double PredictionError(const Calibration& c,
                       const Eigen::VectorXd& state,
                       const NewPlaces& places) {
  const Eigen::VectorXd delta = c.SlotDeltas(state, 0);
  double squares = 0;
  for (Eigen::Index k = 0; k < places.q.rows(); ++k) {
    const Eigen::Isometry3d X_WQ =
        c.chain.Pose<double>(places.q.row(k).transpose(), delta, c.frames.ends({}));
    squares += (X_WQ.translation() - places.points[static_cast<std::size_t>(k)]).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(places.q.rows()));
}

}  // namespace

NoiseStudy RunNoiseStudy(ProblemSpec spec, int draws) {
  const NewPlaces in_ranges(spec, kJointRanges), full_turns(spec, kFullTurns);
  const Eigen::VectorXd truth = ErrorSlots(spec.robot, *spec.simulate);
  NoiseStudy study;
  int covered = 0;
  std::vector<double> errors, errors_full_turns;
  for (int draw = 1; draw <= draws; ++draw) {
    spec.simulate->seed = static_cast<std::uint64_t>(draw);
    const Recording recording = RecordingOf(spec);
    const Calibration c(spec, recording);
    const Fit fit = RunFit(c, SettingsOf(c));
    if (!fit.summary.IsSolutionUsable()) {
      ++study.num_failed;
      continue;
    }
    errors.push_back(PredictionError(c, fit.summary.state, in_ranges));
    errors_full_turns.push_back(PredictionError(c, fit.summary.state, full_turns));
    const std::optional<FitAnalysis> analysed = Analyse(c, fit);
    if (!analysed) {
      ++study.num_failed;
      continue;
    }
    const FitAnalysis& analysis = *analysed;
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
  study.median_full_turns = Median(errors_full_turns);
  return study;
}

}  // namespace dhcal
