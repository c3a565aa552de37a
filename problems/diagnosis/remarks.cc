#include "problems/diagnosis/remarks.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/context.h"
#include "problems/diagnosis/rows/read_out.h"

namespace dhcal {
namespace {

constexpr double kContradicts = 1.5;  // times: no sigma is stated better
constexpr double kNoChance = 1e-3;
constexpr double kCoarse = 0.5;  // of the noise: rounding that can be seen

/// Of a stated noise, by the model that is delivered.
void RemarkOnSigma(const Result& result, std::vector<std::string>* remarks) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr || std::isnan(fit->chi2_reduced) || std::isnan(fit->chi2_p)) return;
  const double ratio = std::sqrt(fit->chi2_reduced);
  const double shown = ratio * result.noise_sigma / kMillimetre;
  const double stated = result.noise_sigma / kMillimetre;
  if (ratio * kContradicts < 1 && fit->chi2_p > 1 - kNoChance) {
    remarks->push_back(fmt::format(
        "The residuals are {:.2g} times smaller than the stated noise of {:.3g} mm (reduced "
        "chi-square {:.2g}, which no chance gives). They show {:.3g} mm: with that as "
        "measurement.sigma_mm the intervals would be {:.2g} times narrower, more parameters would "
        "be identified, and smaller effects found.",
        1 / ratio,
        stated,
        fit->chi2_reduced,
        shown,
        1 / ratio));
  } else if (Widening(result) > 1) {
    remarks->push_back(fmt::format(
        "The residuals are {:.2g} times larger than the stated noise of {:.3g} mm (reduced "
        "chi-square {:.3g}, which no chance gives), without any pattern. The sigmas of parameters "
        "were widened as much.",
        ratio,
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
  const Eigen::VectorXd quanta = ReadOutQuanta(recording, spec.robot);
  if (quanta.isZero(0) || recording.num_rows() == 0) return;
  const PhysicsContext context(result.calibrated, recording, {result.calibrated.X_WB});
  const double moved = RoundingAtPoint(context, quanta);
  const double noise = std::sqrt(3.0) * result.noise_sigma;
  if (!(moved > kCoarse * noise)) return;
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

double Widening(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  const bool consistent =
      result.diagnosis && result.diagnosis->verdict == DiagnosisVerdict::kConsistent;
  if (fit == nullptr || !consistent || !(fit->chi2_p < kNoChance)) return 1;
  const double ratio = std::sqrt(fit->chi2_reduced);
  return ratio > kContradicts ? ratio : 1;
}

std::vector<std::string> Remarks(const ProblemSpec& spec,
                                 const Recording& recording,
                                 const Result& result) {
  std::vector<std::string> remarks;
  if (result.best() == nullptr) return remarks;
  RemarkOnSigma(result, &remarks);
  RemarkOnDecimals(spec, recording, result, &remarks);
  RemarkOnTestRows(recording, &remarks);
  return remarks;
}

}  // namespace dhcal
