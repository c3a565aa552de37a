#include "problems/task/task_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/math/statistics.h"
#include "problems/task/points.h"
#include "problems/task/region.h"

namespace dhcal {
namespace {

constexpr int kPosesInBox = 300;
constexpr int kFewestInBox = 10;
constexpr std::uint64_t kBoxSeed = 20040601;

std::string BoxWords(const TaskBox& box) {
  const auto side = [&](const char* name, int k) {
    return fmt::format("{} {:.4g} to {:.4g}", name, box.low[k], box.high[k]);
  };
  return fmt::format("{}, {}, {} m of the base", side("x", 0), side("y", 1), side("z", 2));
}

Eigen::VectorXd Stacked(const Eigen::Matrix3Xd& points) { return points.reshaped(); }

/// V_k s^-2 V_k' of the directions kept, or V_d V_d' of those dropped, in SI.
Eigen::MatrixXd KeptCovariance(const TruncatedSvd& svd) {
  const Eigen::MatrixXd kept =
      svd.scale.asDiagonal() * svd.kept() * svd.s.head(svd.rank).cwiseInverse().asDiagonal();
  return kept * kept.transpose();
}

Eigen::MatrixXd DroppedCovariance(const TruncatedSvd& svd) {
  const Eigen::MatrixXd dropped = svd.scale.asDiagonal() * svd.dropped();
  return dropped * dropped.transpose();
}

double LargestAtAPose(const Eigen::MatrixXd& J, const Eigen::MatrixXd& covariance) {
  double most = 0;
  for (Eigen::Index row = 0; row + 3 <= J.rows(); row += 3) {
    const auto at = J.middleRows(row, 3);
    most = std::max(most, (at * covariance * at.transpose()).trace());
  }
  return std::sqrt(most);
}

/// The nominal robot's distance from the calibrated one, and what the calibrated one's own
/// uncertainty makes of it.
RegionError ErrorBeforehand(const Eigen::VectorXd& difference,
                            const Eigen::MatrixXd& J,
                            const Eigen::MatrixXd& covariance) {
  const double num_points = static_cast<double>(difference.size()) / 3;
  RegionError error;
  error.rms = std::sqrt(difference.squaredNorm() / num_points);
  const Eigen::VectorXd slope = J.transpose() * difference / (num_points * error.rms);
  const double sigma = error.rms > 0 ? std::sqrt(slope.dot(covariance * slope)) : 0;
  const double reach = StudentTwoSided(0.95, HUGE_VAL) * sigma;
  error.low = std::max(0.0, error.rms - reach);
  error.high = error.rms + reach;
  return error;
}

}  // namespace

TaskError TaskPoses(const ProblemSpec& spec) {
  TaskError task;
  task.aligned = KnowsNoCommonBase(spec);
  if (!spec.task->box) {
    task.q = spec.task->q;
    task.poses = static_cast<int>(task.q.rows());
    task.region = fmt::format("{} poses of {}", task.poses, Printable(spec.task->file));
    return task;
  }
  task.q = DrawInBox(spec.robot, *spec.task->box, kPosesInBox, kBoxSeed);
  task.poses = static_cast<int>(task.q.rows());
  task.region = fmt::format("{} random poses in the box {}", task.poses, BoxWords(*spec.task->box));
  if (task.poses < kFewestInBox) {
    task.unknown = fmt::format(
        "The robot reaches next to nothing of the box {} with its point within its joints' limits "
        "({} poses found in many tries): check 'task.box_m' (in the base's axes) and the tool",
        BoxWords(*spec.task->box),
        task.poses);
  }
  return task;
}

RegionError ExpectedError(const Eigen::MatrixXd& J, const Eigen::MatrixXd& covariance) {
  RegionError error;
  const double num_points = static_cast<double>(J.rows()) / 3;
  const Eigen::MatrixXd weights = J.transpose() * J / num_points;
  const Eigen::MatrixXd product = weights * covariance;
  const double mean = product.trace();
  // trace((W C)^2) = sum of the squares of the mean square's weights.
  const double squares = product.cwiseProduct(product.transpose()).sum();
  error.rms = std::sqrt(std::max(0.0, mean));
  error.low = error.high = error.rms;
  if (!(mean > 0) || !(squares > 0)) return error;
  const double dof = mean * mean / squares;
  error.low = error.rms * std::sqrt(ChiSquareQuantile(0.025, dof) / dof);
  error.high = error.rms * std::sqrt(ChiSquareQuantile(0.975, dof) / dof);
  return error;
}

void FillTaskError(const Calibration& c,
                   const Identifiability& identifiability,
                   const Eigen::VectorXd& state,
                   TaskError* task) {
  if (!task->unknown.empty()) return;
  const PredictedPoints after = PointsAt(c, state, task->q);
  if (task->p_nominal.cols() == 0) {
    task->p_nominal = PointsAt(c, Eigen::VectorXd::Zero(state.size()), task->q).p_WQ;
  }
  task->left_out = after.left_out;
  Eigen::MatrixXd J = after.J;
  Eigen::VectorXd difference = Stacked(task->p_nominal) - Stacked(after.p_WQ);
  if (task->aligned) {
    J = WithoutMotion(after.p_WQ, J);
    difference = WithoutMotion(after.p_WQ, difference);
  }
  const TruncatedSvd& svd = identifiability.all;
  const Eigen::MatrixXd kept = KeptCovariance(svd);
  task->before = ErrorBeforehand(difference, J, kept);
  task->after = ExpectedError(J, kept);
  task->after_largest = LargestAtAPose(J, kept);
  task->hidden = ExpectedError(J, DroppedCovariance(svd)).rms;
}

}  // namespace dhcal
