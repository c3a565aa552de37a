#include "problems/diagnosis/remarks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/context.h"
#include "problems/diagnosis/rows/read_out.h"

namespace dhcal {
namespace {

constexpr double kContradicts = 1.5;  // times: no sigma is stated better
constexpr double kImprobable = 1e-3;
constexpr double kDistinct = 0.8;  // part of the rows: fewer poses are repeated ones
constexpr double kShared = 1.2;    // what so many poses' sums exceed by no chance
constexpr double kCoarse = 0.5;    // of the noise: rounding that can be seen

/// Of a stated noise that chance does not enlarge so, where nothing structured is left: how many
/// times larger the residuals are; else 1.
double WidenedByNoise(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  const bool consistent =
      result.diagnosis && result.diagnosis->verdict == DiagnosisVerdict::kConsistent;
  if (fit == nullptr || !consistent || !(fit->chi2_p < kImprobable)) return 1;
  const double ratio = std::sqrt(fit->chi2_reduced);
  return ratio > kContradicts ? ratio : 1;
}

/// Rows of one pose (repeats, several targets) that err alike count for less than their number: the
/// root of the squares of the poses' sums over those of the rows.
double WidenedByPoses(const Recording& recording, const Result& result) {
  if (result.kind.pairs || result.kind.anchors) return 1;
  std::map<int, Eigen::VectorXd> sum_of_pose;
  const std::vector<int> poses = PosesOfRows(recording);
  double squares = 0;
  int rows = 0;
  for (const RowResidual& row : result.residuals) {
    if (row.test || !row.set_aside.empty() || row.residual.size() == 0) continue;
    const int pose = poses[static_cast<std::size_t>(row.row_idx)];
    const auto entry = sum_of_pose.try_emplace(pose, Eigen::VectorXd::Zero(row.residual.size()));
    entry.first->second += row.standardised;
    squares += row.standardised.squaredNorm();
    ++rows;
  }
  const bool repeated = static_cast<double>(sum_of_pose.size()) < kDistinct * rows;
  if (!repeated || !(squares > 0)) return 1;
  double of_poses = 0;
  for (const auto& [pose, sum] : sum_of_pose) of_poses += sum.squaredNorm();
  const double factor = of_poses / squares;
  return factor > kShared ? std::sqrt(factor) : 1;
}

/// "3.2", "510": two digits.
std::string TimesText(double factor) {
  return factor < 10 ? fmt::format("{:.1f}", factor)
                     : fmt::format("{:.0f}", factor < 100 ? factor : 10 * std::round(factor / 10));
}

/// Of a stated noise, by the model that is delivered.
void RemarkOnSigma(const Result& result,
                   const Widening& widening,
                   std::vector<std::string>* remarks) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr || std::isnan(fit->chi2_reduced) || std::isnan(fit->chi2_p)) return;
  const double ratio = std::sqrt(fit->chi2_reduced);
  const double shown = ratio * result.noise_sigma / kMillimetre;
  const double stated = result.noise_sigma / kMillimetre;
  if (result.noise_free) return;  // a simulation, whose stated noise is that of another one
  if (ratio * kContradicts < 1 && fit->chi2_p > 1 - kImprobable) {
    remarks->push_back(fmt::format(
        "The residuals are {} times smaller than the stated noise of {:.3g} mm (reduced "
        "chi-square {:.2g}, which no chance gives). They show {:.3g} mm: with that as "
        "measurement.sigma_mm the intervals would be {} times narrower, more parameters would "
        "be identified, and smaller effects found.",
        TimesText(1 / ratio),
        stated,
        fit->chi2_reduced,
        shown,
        TimesText(1 / ratio)));
  } else if (widening.by_noise > 1) {
    remarks->push_back(fmt::format(
        "The residuals are {} times larger than the stated noise of {:.3g} mm (reduced "
        "chi-square {:.3g}, which no chance gives), without any pattern. The sigmas of parameters "
        "were widened as much.",
        TimesText(ratio),
        stated,
        fit->chi2_reduced));
  }
}

/// How far rounding of the joints' read-outs moves the point, RMS over the rows [m].
double RoundingAtPoint(const PhysicsContext& c, const Eigen::VectorXd& quanta) {
  double squares = 0;
  for (int row = 0; row < c.num_rows(); ++row) {
    const Eigen::Vector3d p_BQ = c.X_WB(row).inverse() * c.p_WQ(row);
    for (int joint = 0; joint < c.num_joints(); ++joint) {
      const double lever =
          c.revolute(joint) ? c.axis(row, joint).cross(p_BQ - c.axis_point(row, joint)).norm() : 1;
      squares += std::pow(lever * quanta[joint], 2) / 12;  // of a uniform error
    }
  }
  return std::sqrt(squares / std::max(1, c.num_rows()));
}

/// "0.01 deg", of the coarsest turning joint, else "0.1 mm" of the coarsest slide.
std::string QuantumWords(const PhysicsContext& c, const Eigen::VectorXd& quanta) {
  double angle = 0, length = 0;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    double& coarsest = c.revolute(joint) ? angle : length;
    coarsest = std::max(coarsest, quanta[joint]);
  }
  return angle > 0 ? fmt::format("{:.2g} deg", angle / kDegree)
                   : fmt::format("{:.2g} mm", length / kMillimetre);
}

void RemarkOnDecimals(const ProblemSpec& spec,
                      const Recording& recording,
                      const Result& result,
                      std::vector<std::string>* remarks) {
  const Eigen::VectorXd quanta = ReadOutOf(recording, spec.robot).last_digit();
  if (quanta.isZero(0) || recording.num_rows() == 0) return;
  const PhysicsContext context(result.calibrated, recording, {result.calibrated.X_WB});
  const double moved = RoundingAtPoint(context, quanta);
  const double noise = std::sqrt(3.0) * result.noise_sigma;
  if (!(moved > kCoarse * noise)) return;
  // What leaves less than rounding must was not rounded: such angles were commanded.
  const FitResult* const fit = result.delivered_fit();
  if (fit != nullptr && std::sqrt(3.0) * fit->rms < kCoarse * moved) return;
  remarks->push_back(fmt::format(
      "The joint coordinates were written in steps of {}. This rounding alone moves the point by "
      "{:.2g} mm RMS (3-D), beside a noise of {:.2g} mm: no model of this recording can leave "
      "less. Record the joints with more decimals.",
      QuantumWords(context, quanta),
      moved / kMillimetre,
      noise / kMillimetre));
}

void RemarkOnTestRows(const Recording& recording, std::vector<std::string>* remarks) {
  if (recording.is_test.empty()) return;
  const std::vector<int> poses = PosesOfRows(recording);
  std::set<int> fitted;
  for (int row = 0; row < recording.num_rows(); ++row) {
    if (!recording.test(row)) fitted.insert(poses[static_cast<std::size_t>(row)]);
  }
  int tests = 0, seen = 0;
  for (int row = 0; row < recording.num_rows(); ++row) {
    if (!recording.test(row)) continue;
    ++tests;
    if (fitted.count(poses[static_cast<std::size_t>(row)]) > 0) ++seen;
  }
  if (seen == 0) return;
  remarks->push_back(fmt::format(
      "{} of {} test rows have the joint coordinates of fitted rows: what is said of unseen rows "
      "proves nothing for these. Keep whole poses unseen.",
      seen,
      tests));
}

}  // namespace

Widening WideningOf(const Recording& recording, const Result& result) {
  return {WidenedByNoise(result), WidenedByPoses(recording, result)};
}

std::vector<std::string> Remarks(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Result& result,
                                 const Widening& widening) {
  std::vector<std::string> remarks;
  if (result.best() == nullptr) return remarks;
  RemarkOnSigma(result, widening, &remarks);
  RemarkOnDecimals(spec, recording, result, &remarks);
  RemarkOnTestRows(recording, &remarks);
  if (widening.by_poses > 1) {
    remarks.push_back(fmt::format(
        "Rows with the same joint coordinates err alike: they are fewer draws than rows, and the "
        "sigmas of parameters were widened {:.2g} times.",
        widening.by_poses));
  }
  return remarks;
}

}  // namespace dhcal
