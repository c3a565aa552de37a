#include "core/analysis/null_space.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/null_space_words.h"

namespace dhcal {
namespace {

// Entries below this share of the largest (in tolerances) are left out of a direction, if without
// them it is as hidden as with them; else the next share is tried.
constexpr double kNegligible[] = {0.02, 0.005, 1e-3, 1e-4, 0.0};
constexpr double kParallel = 0.02;  // [rad]

/// The direction without entries below `share` of its largest.
Eigen::VectorXd Without(const Eigen::VectorXd& direction, double share) {
  const double least = share * direction.cwiseAbs().maxCoeff();
  return (direction.array().abs() < least).select(0.0, direction);
}

/// By how many noise units a move along the direction changes the readings.
double Gain(const TruncatedSvd& svd, const Eigen::VectorXd& direction) {
  return svd.s.cwiseProduct(svd.V.transpose() * direction).norm();
}

/// The shortest form of a direction that the readings see no better than the whole.
Eigen::VectorXd Shortened(const TruncatedSvd& svd, const Eigen::VectorXd& direction) {
  const double allowed = std::max(1.0, 1.1 * Gain(svd, direction));
  for (const double share : kNegligible) {
    Eigen::VectorXd shorter = Without(direction, share);
    if (Gain(svd, shorter) <= allowed) return shorter;
  }
  return direction;
}

NullDirection Named(const Eigen::VectorXd& direction,
                    const Eigen::VectorXd& scale,
                    const std::vector<Parameter>& parameters) {
  NullDirection result;
  double largest = 0;
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    if (direction[k] == 0) continue;
    const double weight = direction[k] * scale[k];
    result.direction.push_back({parameters[static_cast<std::size_t>(k)].name, weight});
    if (std::abs(weight) > std::abs(largest)) largest = weight;
  }
  for (NullDirection::Entry& entry : result.direction) entry.weight /= largest;
  return result;
}

}  // namespace

Eigen::MatrixXd SparseBasis(const Eigen::MatrixXd& directions) {
  Eigen::MatrixXd rows = directions.transpose();
  for (Eigen::Index done = 0; done < rows.rows(); ++done) {
    Eigen::Index pivot_row = 0, pivot_col = 0;
    rows.bottomRows(rows.rows() - done).cwiseAbs().maxCoeff(&pivot_row, &pivot_col);
    rows.row(done).swap(rows.row(done + pivot_row));
    rows.row(done) /= rows(done, pivot_col);
    for (Eigen::Index other = 0; other < rows.rows(); ++other) {
      if (other != done) rows.row(other) -= rows(other, pivot_col) * rows.row(done);
    }
  }
  return rows;
}

std::vector<NullDirection> ExplainNullSpace(const TruncatedSvd& svd,
                                            const std::vector<Parameter>& parameters,
                                            const RobotModel& robot,
                                            const MeasurementKind& kind) {
  const Eigen::MatrixXd basis = SparseBasis(svd.dropped());
  std::vector<NullDirection> result;
  for (Eigen::Index k = 0; k < basis.rows(); ++k) {
    result.push_back(Named(Shortened(svd, basis.row(k).transpose()), svd.scale, parameters));
  }
  // The shortest are the plainest; ties in the order of the parameters.
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.direction.size() < b.direction.size();
  });
  WriteExplanations(robot, kind, parameters, &result);
  return result;
}

bool AxesParallel(const RobotModel& robot, int joint_i, int joint_j) {
  for (int k = std::min(joint_i, joint_j); k < std::max(joint_i, joint_j); ++k) {
    const JointRow& row = robot.joints[robot.row_between(k)];
    if (std::abs(std::sin(row.alpha)) > kParallel || std::abs(std::sin(row.beta)) > kParallel) {
      return false;
    }
  }
  return true;
}

}  // namespace dhcal
