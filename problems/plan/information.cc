#include "problems/plan/information.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "problems/assembly.h"

namespace dhcal {
namespace {

// Eigenvalues below this share of the largest are rounding: singular values below 1e-6 of it.
constexpr double kRounding = 1e-12;

/// Where the columns of a calibration go in the sums of one group: first those asked for, then the
/// group's own.
struct GroupSum {
  std::vector<int> column_of;  // per place: parameter of the calibration, -1 = none
  Eigen::MatrixXd gram;
};

std::vector<GroupSum> EmptySums(const Calibration& c,
                                const std::vector<std::string>& names,
                                const RowGroups& groups) {
  std::map<std::string, int> shared;
  for (const std::string& name : names) shared.emplace(name, -1);
  std::vector<std::set<int>> own(static_cast<std::size_t>(groups.count));
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const Parameter& p = c.parameters[k];
    if (const auto asked = shared.find(p.name); asked != shared.end()) {
      asked->second = static_cast<int>(k);
      continue;
    }
    for (int row = 0; row < c.recording.num_rows(); ++row) {
      const int group = groups.of_row[static_cast<std::size_t>(row)];
      if (group < 0 || !p.scope.Holds(c.Labels(row))) continue;
      own[static_cast<std::size_t>(group)].insert(static_cast<int>(k));
    }
  }
  std::vector<GroupSum> sums(own.size());
  for (std::size_t group = 0; group < own.size(); ++group) {
    GroupSum& sum = sums[group];
    for (const std::string& name : names) sum.column_of.push_back(shared[name]);
    sum.column_of.insert(sum.column_of.end(), own[group].begin(), own[group].end());
    const auto size = static_cast<Eigen::Index>(sum.column_of.size());
    sum.gram = Eigen::MatrixXd::Zero(size, size);
  }
  return sums;
}

/// Adds a row of the Jacobian, its columns scaled.
void AddRow(const Eigen::RowVectorXd& row, const Eigen::VectorXd& tolerance, GroupSum* sum) {
  Eigen::VectorXd picked(sum->gram.rows());
  for (Eigen::Index k = 0; k < picked.size(); ++k) {
    const int column = sum->column_of[static_cast<std::size_t>(k)];
    picked[k] = column < 0 ? 0.0 : row[column] * tolerance[column];
  }
  for (Eigen::Index k = 0; k < picked.size(); ++k) sum->gram.col(k) += picked[k] * picked;
}

/// What is left for the first `count` columns when the others are unknown.
Eigen::MatrixXd Reduced(const Eigen::MatrixXd& lower, Eigen::Index count) {
  Eigen::MatrixXd gram = lower.selfadjointView<Eigen::Lower>();
  const Eigen::Index others = gram.rows() - count;
  if (others == 0) return gram;
  const auto cross = gram.bottomLeftCorner(others, count);
  const Eigen::MatrixXd known =
      gram.bottomRightCorner(others, others) + Eigen::MatrixXd::Identity(others, others);
  return gram.topLeftCorner(count, count) - cross.transpose() * known.llt().solve(cross);
}

}  // namespace

std::vector<Eigen::MatrixXd> InformationOf(const Calibration& c,
                                           const Noise& noise,
                                           const std::vector<std::string>& names,
                                           const RowGroups& groups) {
  std::vector<GroupSum> sums = EmptySums(c, names, groups);
  const Eigen::VectorXd tolerance = ScalesOf(c.parameters).tolerance;
  const ReadingRows rows = RowsOf(c, c.readings.fitted);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(tolerance.size());
  rows.Visit(start, RowNoiseOf(c, noise), [&](const TileRows& tile) {
    const auto num_readings = static_cast<Eigen::Index>(tile.readings.size());
    for (Eigen::Index k = 0; k < tile.J().rows(); ++k) {
      const auto reading =
          static_cast<std::size_t>(tile.readings[static_cast<std::size_t>(k % num_readings)]);
      const int row = c.readings.fitted[reading].row_idx;
      const int group = groups.of_row[static_cast<std::size_t>(row)];
      if (group >= 0) AddRow(tile.J().row(k), tolerance, &sums[static_cast<std::size_t>(group)]);
    }
  });
  std::vector<Eigen::MatrixXd> informations;
  informations.reserve(sums.size());
  for (const GroupSum& sum : sums) {
    informations.push_back(Reduced(sum.gram, static_cast<Eigen::Index>(names.size())));
  }
  return informations;
}

Eigen::MatrixXd RowsOfInformation(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const Eigen::VectorXd& values = eigen.eigenvalues();  // ascending
  const double least = kRounding * std::max(values.maxCoeff(), 0.0);
  const auto rank = static_cast<Eigen::Index>((values.array() > least).count());
  return values.tail(rank).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().rightCols(rank).transpose();
}

Eigen::MatrixXd UnseenBy(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const double least = kRounding * std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  const auto unseen = static_cast<Eigen::Index>((eigen.eigenvalues().array() <= least).count());
  const auto directions = eigen.eigenvectors().leftCols(unseen);
  return directions * directions.transpose();
}

}  // namespace dhcal
