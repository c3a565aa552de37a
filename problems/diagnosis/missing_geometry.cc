#include "problems/diagnosis/missing_geometry.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/statistics.h"
#include "problems/assembly.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/concealed_frame.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/projection.h"
#include "problems/noise.h"
#include "problems/parameter_values.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

struct Gain {
  double p = 1;
  double removed = 0;
  Eigen::MatrixXd basis;
};

Gain GainOf(const Eigen::MatrixXd& U,
            const Eigen::MatrixXd& columns,
            const Eigen::VectorXd& y,
            double dof,
            bool sigma_known) {
  Gain gain;
  // What the file's own parameters can do is not missing.
  gain.basis = OrthonormalBasis(ProjectOff(U, columns));
  const Eigen::VectorXd norms = columns.colwise().norm();
  if (gain.basis.cols() == 0 || norms.maxCoeff() <= 0) return gain;
  if (ProjectOff(U, columns).norm() < 1e-6 * columns.norm()) {
    gain.basis.resize(columns.rows(), 0);
    return gain;
  }
  gain.removed = (gain.basis.transpose() * y).squaredNorm();
  const auto k = static_cast<double>(gain.basis.cols());
  gain.p = RemovalTail(gain.removed, k, y.squaredNorm(), dof, sigma_known);
  return gain;
}

}  // namespace

bool AddMissingGeometry(const ProblemSpec& spec,
                        const Recording& recording,
                        const Result& identified,
                        const CompleteFit& complete,
                        const std::vector<Reading>& readings,
                        DiagnosisResult* d) {
  const std::vector<Completion> missing =
      MissingCompletions(Calibration(spec, recording), complete.calibration);
  if (missing.empty()) return false;
  const auto held = AddConcealedFrames(spec, recording, identified, complete, missing, d);
  // At the file's own answer, all corrections in it; where a frame was concealed or there is no
  // answer, at that of the fit held to the drawing.
  ProblemSpec user_spec = held->spec;
  user_spec.measurement = spec.measurement;
  user_spec.robot = identified.calibrated;
  if (!d->findings.empty() || identified.best() == nullptr) {
    if (!held->usable()) return true;
    user_spec.robot = CalibratedRobot(held->calibration, held->state());
  }
  const Calibration user(user_spec, recording);
  const std::vector<Completion> completions = MissingCompletions(user, complete.calibration);
  if (completions.empty()) return true;
  const Eigen::VectorXd zero =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(user.parameters.size()));
  const DesignRows rows(user, zero, complete.fit.noise_seen, readings);
  // Only what the file's fit can move within the tolerances: near parallel axes plain DH rows can
  // imitate a tilt, with corrections of metres.
  Eigen::MatrixXd J_user = rows.Geometry(user.parameters);
  const Eigen::VectorXd tolerance = ScalesOf(user.parameters).tolerance;
  J_user = J_user * tolerance.asDiagonal();
  Eigen::MatrixXd U = BasisAbove(J_user, 1.0);
  Eigen::VectorXd y = ProjectOff(U, rows.y());
  const bool sigma_known = SourceOfNoise(user).all_given();
  const double level =
      kShareOfGeometry * spec.diagnosis.false_alarm / static_cast<double>(completions.size());
  std::vector<bool> used(completions.size(), false);
  while (true) {
    std::size_t best = completions.size();
    Gain best_gain;
    for (std::size_t k = 0; k < completions.size(); ++k) {
      if (used[k]) continue;
      const std::vector<Parameter>& parameters = completions[k].parameters;
      const Eigen::MatrixXd J = rows.Geometry(parameters);
      const auto dof = static_cast<double>(rows.degrees_of_freedom() - U.cols());
      const Gain gain = GainOf(U, J, y, dof, sigma_known);
      if (gain.p > level) continue;
      if (best < completions.size() && gain.removed <= best_gain.removed) continue;
      best = k;
      best_gain = gain;
    }
    if (best == completions.size()) break;
    used[best] = true;
    Eigen::MatrixXd wider(U.rows(), U.cols() + best_gain.basis.cols());
    wider << U, best_gain.basis;
    U = wider;
    const double sigma = complete.fit.noise_seen.sigma;
    const double rms_before = sigma * std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    y = ProjectOff(best_gain.basis, y);
    Finding finding =
        DescribeCompletion(completions[best], complete.calibration, complete.fit, best_gain.p);
    finding.rms_train_before = rms_before;
    finding.rms_train_after = sigma * std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    d->findings.push_back(finding);
  }
  if (d->findings.empty() || user.readings.test.empty()) return true;
  // Rows never fitted: by the file's own answer, and by the complete geometry.
  d->validation_method = "set column";
  d->rms_test_before = Statistics(user, zero, user.readings.test).rms;
  const Calibration& c = complete.calibration;
  d->rms_test_after = Statistics(c, complete.state(), c.readings.test).rms;
  return true;
}

}  // namespace dhcal
