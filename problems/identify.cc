#include "problems/identify.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/fit_analysis.h"
#include "problems/judgement.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"
#include "problems/prediction.h"
#include "problems/start.h"
#include "problems/task/task_error.h"
#include "problems/validation.h"

namespace dhcal {
namespace {

// No calibration error is as large [m].
constexpr double kNotThisRobot = 0.02;

Baseline BaselineOf(const Calibration& c, const Eigen::VectorXd& state) {
  const ResidualStatistics s = Statistics(c, state, c.readings.fitted);
  return {s.rms, s.rms_point, s.max_point};
}

std::vector<SolverMethod> Methods(SolverMethod asked) {
  if (asked != SolverMethod::kBoth) return {asked};
  return {SolverMethod::kSvdGaussNewton, SolverMethod::kLevenbergMarquardt};
}

void AddNotes(const Calibration& c, const std::vector<Fit>& fits, Result* result) {
  for (const Fit& fit : fits) {
    if (fit.noise_settled || !fit.summary.IsSolutionUsable()) continue;
    result->notes.push_back(fmt::format(
        "{}: the noise was still changing when its rounds ended (assumed {:.3g} mm, the residuals "
        "show {:.3g} mm), and the solution depends on it; state measurement.sigma_mm.",
        ToString(fit.method),
        fit.noise.sigma / kMillimetre,
        fit.noise_seen.sigma / kMillimetre));
  }
  if (!SourceOfNoise(c).sigma_given && result->noise_sigma <= kFinestSigma) {
    result->notes.push_back(fmt::format(
        "The residuals are smaller than any instrument's noise. What can be trusted is judged as "
        "if one coordinate were read to {:g} um; give measurement.sigma_mm for your instrument.",
        kFinestSigma / kMicrometre));
  }
  if (c.measurement->kind().pairs && c.spec.measurement.noise == NoiseKind::kIndependent &&
      c.recording.displacement.rows() == 0) {
    result->notes.push_back(
        "Differences were taken from readings of single poses, so each reading's error enters two "
        "of them; 'noise: shared_pose' would weigh that exactly.");
  }
  if (result->base_and_tool_only && result->base_and_tool_only->rms > kNotThisRobot) {
    result->notes.push_back(fmt::format(
        "The nominal robot with base and tool fitted misses the readings by {:.0f} mm: check the "
        "joints' order, signs and units, the DH convention and the nominal lengths.",
        result->base_and_tool_only->rms / kMillimetre));
  }
  if (result->best() == nullptr) return;
  // Fixed scale: no reading of a length standard is in such data.
  result->notes.push_back(
      "A common scale error of all lengths (instrument, ruler or temperature) cannot be told from "
      "a robot that is larger or smaller by the same factor.");
}

/// False where an edge stands nobody knows where before the readings are looked at.
bool HasAllFrames(const ProblemSpec& spec, const Recording& recording) {
  if (!spec.robot.base_per_edge) return true;
  const auto& edges = spec.robot.edges;
  return std::all_of(
      recording.edge_names.begin(), recording.edge_names.end(), [&](const std::string& name) {
        return std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
          return edge.name == name && edge.X_WE;
        });
      });
}

/// Analyses and describes each fit; the first usable one is the answer.
void DescribeFits(const Calibration& c, const std::vector<Fit>& fits, Result* result) {
  std::optional<FitAnalysis> best_analysis;
  for (const Fit& fit : fits) {
    std::optional<FitAnalysis> analysis;
    if (fit.summary.IsSolutionUsable()) analysis = Analyse(c, fit);
    result->fits.push_back(DescribeFit(c, fit, analysis ? &*analysis : nullptr));
    if (analysis && result->best_fit < 0) {
      result->best_fit = static_cast<int>(result->fits.size()) - 1;
      best_analysis = analysis;
    }
  }
  result->noise_sigma = fits.front().noise.sigma;
  if (result->best_fit < 0) return;
  const Fit& best = fits[static_cast<std::size_t>(result->best_fit)];
  const Eigen::VectorXd& state = best.summary.state;
  result->noise_sigma = best_analysis->noise.sigma;
  if (c.measurement->kind().sees_orientation()) {
    result->noise_sigma_rotation = best_analysis->noise.sigma_rotation;
  }
  if (fits.size() == 2 && fits[0].summary.IsSolutionUsable() &&
      fits[1].summary.IsSolutionUsable()) {
    result->comparison =
        CompareFits(c, best_analysis->identifiability, state, fits[1].summary.state);
  }
  result->validation = Validate(c, *best_analysis, *best.problem);
  result->residuals = DescribeRows(c, *best_analysis, *best.problem);
  result->calibrated = CalibratedRobot(c, state);
  if (c.spec.task) {
    result->task = TaskPoses(c.spec);
    FillTaskError(c, best_analysis->identifiability, state, &*result->task);
  }
}

}  // namespace

void CheckEnoughReadings(const ProblemSpec& spec,
                         const Recording& recording,
                         Diagnostics* diagnostics) {
  const Calibration c(spec, recording);
  const auto unknowns = c.parameters.size();
  const std::size_t numbers =
      c.readings.fitted.size() * static_cast<std::size_t>(spec.measurement.kind.num_coordinates());
  if (unknowns == 0) {
    diagnostics->Error(spec.parameters.where,
                       "parameters: nothing is left to estimate; name a group in 'estimate' that "
                       "'fix' does not take away");
  } else if (c.readings.fitted.empty() && spec.measurement.kind.pairs) {
    diagnostics->Error(
        {recording.file, 0, 0},
        "no two consecutive rows share run, target, edge and set, so there is no difference to "
        "fit; "
        "give rows that follow each other the same run, target and edge, and mark whole runs or "
        "stretches of rows 'test', not single rows");
  } else if (numbers < unknowns) {
    diagnostics->Error(
        {recording.file, 0, 0},
        fmt::format("{} readings give {} numbers, fewer than the {} free parameters; record more "
                    "poses or estimate less",
                    c.readings.fitted.size(),
                    numbers,
                    unknowns));
  } else if (numbers == unknowns && !SourceOfNoise(c).all_given()) {
    diagnostics->Error(
        {recording.file, 0, 0},
        fmt::format("{} numbers for as many free parameters leave nothing to estimate the noise "
                    "from; state measurement.sigma_mm (for poses sigma_rotation_mrad, too), record "
                    "more poses or estimate less",
                    numbers));
  }
}

Result IdentifyGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Progress& progress) {
  Calibration c(spec, recording);
  Result result;
  result.problem = spec.name;
  result.program_version = DHCAL_VERSION;
  result.kind = spec.measurement.kind;
  result.rows = static_cast<int>(c.readings.fitted.size());
  result.rows_test = static_cast<int>(c.readings.test.size());
  result.num_poses = recording.num_rows();
  result.simulated = spec.simulate.has_value();
  for (const MeasuredCoordinate& coordinate : spec.measurement.kind.coordinates) {
    result.coordinate_names.push_back(coordinate.name);
  }
  result.calibrated = spec.robot;
  result.noise_source = SourceOfNoise(c).description;
  if (HasAllFrames(spec, recording)) {
    result.nominal =
        BaselineOf(c, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.parameters.size())));
  }

  AlignStart(&c);
  if (const auto frames_alone = FitFramesAlone(&c, progress)) {
    result.base_and_tool_only =
        Baseline{frames_alone->rms, frames_alone->rms_point, frames_alone->max_point};
  }
  FitSettings settings = SettingsOf(c, progress);
  std::vector<Fit> fits;
  for (const SolverMethod method : Methods(spec.solver.method)) {
    settings.method = method;
    const bool known = !fits.empty() && fits[0].summary.IsSolutionUsable();
    if (known) settings.noise = fits[0].noise_seen;
    // The second solver is compared on the arm that the first has found.
    fits.push_back(known ? RunFit(c, settings) : RunBentFit(settings, &c));
  }
  DescribeFits(c, fits, &result);
  AddNotes(c, fits, &result);
  result.noise_free = IsNoiseFree(result);
  result.intervals = JudgeIntervals(result);
  return result;
}

}  // namespace dhcal
