#include "core/analysis/null_space.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/null_space_words.h"

namespace dhcal {
namespace {

// An entry below this share of the largest (in tolerances) is not worth a word.
constexpr double kNegligible = 0.02;
constexpr double kParallel = 1e-6;  // [rad]

NullDirection Named(const Eigen::VectorXd& direction,
                    const Eigen::VectorXd& scale,
                    const std::vector<Parameter>& parameters) {
  const double largest_scaled = direction.cwiseAbs().maxCoeff();
  NullDirection result;
  double largest = 0;
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    if (std::abs(direction[k]) < kNegligible * largest_scaled) continue;
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
                                            MeasurementKind kind) {
  const Eigen::MatrixXd basis = SparseBasis(svd.dropped());
  std::vector<NullDirection> result;
  for (Eigen::Index k = 0; k < basis.rows(); ++k) {
    result.push_back(Named(basis.row(k).transpose(), svd.scale, parameters));
  }
  // The shortest are the plainest; ties in the order of the parameters.
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.direction.size() < b.direction.size();
  });
  WriteExplanations(robot, kind, parameters, &result);
  return result;
}

bool AxesParallel(const RobotModel& robot, int joint_i, int joint_j) {
  // Standard rows twist after their joint, modified rows before it.
  const int shift = robot.convention == DhConvention::kStandard ? 0 : 1;
  for (int k = std::min(joint_i, joint_j); k < std::max(joint_i, joint_j); ++k) {
    const JointRow& row = robot.joints[static_cast<std::size_t>(k + shift)];
    if (std::abs(std::sin(row.alpha)) > kParallel || std::abs(std::sin(row.beta)) > kParallel) {
      return false;
    }
  }
  return true;
}

}  // namespace dhcal
