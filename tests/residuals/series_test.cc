#include "residuals/series.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/matchers.h"

namespace dhcal {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of one or several series in random order of series.
struct Series {
  std::vector<int> previous;
  VectorXd sigma;
};

Series MakeSeries(int num_rows, int num_series, bool equal_sigmas, Rng* rng) {
  Series series;
  series.sigma.resize(num_rows);
  std::vector<int> last(static_cast<std::size_t>(num_series), -1);
  for (int row_idx = 0; row_idx < num_rows; ++row_idx) {
    const auto of = static_cast<std::size_t>(rng->Uniform(0, num_series));
    series.previous.push_back(last[of]);
    last[of] = row_idx;
    series.sigma[row_idx] = equal_sigmas ? 2e-5 : 2e-5 * std::exp(rng->Uniform(-2, 2));
  }
  return series;
}

/// Adjacent differences as a matrix, pairs x rows.
MatrixXd DifferenceOperator(const Series& series) {
  const auto num_rows = static_cast<Eigen::Index>(series.previous.size());
  MatrixXd D(0, num_rows);
  for (Eigen::Index row = 0; row < num_rows; ++row) {
    const int before = series.previous[static_cast<std::size_t>(row)];
    if (before < 0) continue;
    D.conservativeResize(D.rows() + 1, num_rows);
    D.bottomRows(1).setZero();
    D(D.rows() - 1, row) = 1;
    D(D.rows() - 1, before) = -1;
  }
  return D;
}

/// Whitened contrasts of `values` (3 x rows * stride), stacked: 3 rows per pair, stride columns.
MatrixXd Contrasts(const Series& series, const Matrix3Xd& values, Eigen::Index stride) {
  std::map<int, SeriesWhitener> open;  // by the row that ends a series so far
  MatrixXd result(0, stride);
  for (int row_idx = 0; row_idx < static_cast<int>(series.previous.size()); ++row_idx) {
    const int before = series.previous[static_cast<std::size_t>(row_idx)];
    if (before < 0) {
      open.emplace(row_idx, SeriesWhitener(3, static_cast<int>(stride), series.sigma[row_idx]));
      continue;
    }
    auto node = open.extract(before);
    node.key() = row_idx;
    open.insert(std::move(node));
    MatrixXd pair =
        values.middleCols(row_idx * stride, stride) - values.middleCols(before * stride, stride);
    open.at(row_idx).Whiten(series.sigma[row_idx], pair);
    result.conservativeResize(result.rows() + 3, stride);
    result.bottomRows(3) = pair;
  }
  return result;
}

/// (D v)' (D diag(sigma^2) D')^-1 (D v), summed over the three coordinates; v is rows x stride.
MatrixXd DenseQuadraticForm(const Series& series, const Matrix3Xd& values, Eigen::Index stride) {
  const MatrixXd D = DifferenceOperator(series);
  const MatrixXd covariance = D * series.sigma.cwiseAbs2().asDiagonal() * D.transpose();
  const Eigen::LLT<MatrixXd> factor(covariance);
  MatrixXd sum = MatrixXd::Zero(stride, stride);
  for (int coordinate = 0; coordinate < 3; ++coordinate) {
    MatrixXd v(D.cols(), stride);
    for (Eigen::Index row = 0; row < D.cols(); ++row) {
      v.row(row) = values.block(coordinate, row * stride, 1, stride);
    }
    sum += (D * v).transpose() * factor.solve(D * v);
  }
  return sum;
}

struct Shape {
  int num_rows;
  int num_series;
};

TEST(SeriesWhitener, WhitenedContrastsAreGeneralisedLeastSquares) {
  Rng rng(1);
  for (const bool equal_sigmas : {true, false}) {
    for (const Shape& shape : {Shape{2, 1}, Shape{3, 1}, Shape{100, 1}, Shape{60, 4}}) {
      SCOPED_TRACE(testing::Message() << shape.num_rows << " rows, " << shape.num_series
                                      << " series, equal sigmas " << equal_sigmas);
      const Series series = MakeSeries(shape.num_rows, shape.num_series, equal_sigmas, &rng);
      // Columns 0 to 3 as a Jacobian, the last as residuals: all of [J, r]' Sigma^-1 [J, r].
      const Eigen::Index stride = 5;
      Matrix3Xd values(3, shape.num_rows * stride);
      for (double& value : values.reshaped()) value = rng.Normal();
      const MatrixXd contrasts = Contrasts(series, values, stride);
      const MatrixXd expected = DenseQuadraticForm(series, values, stride);
      EXPECT_THAT(contrasts.transpose() * contrasts,
                  MatrixNear(expected, 1e-10 * expected.lpNorm<Eigen::Infinity>()));
    }
  }
}

TEST(SeriesWhitener, FirstContrastIsThePlainDifference) {
  SeriesWhitener series(3, 1, 3.0);
  MatrixXd pair = Eigen::Vector3d(6, 6, 6);
  series.Whiten(4.0, pair);
  EXPECT_THAT(pair, MatrixNear(Eigen::Vector3d::Constant(6 / 5.0), 1e-15));
}

TEST(SeriesWhitener, WeightsByTheInverseVariances) {
  SeriesWhitener series(1, 1, 1.0);
  MatrixXd second = MatrixXd::Constant(1, 1, 10), third = MatrixXd::Constant(1, 1, 10);
  series.Whiten(2.0, second);
  series.Whiten(5.0, third);
  // Errors 0, 10, 20: the first two have the mean 10 / 4 / 1.25 = 2.
  EXPECT_NEAR(third(0, 0), (20 - 2) / std::sqrt(25 + 1 / 1.25), 1e-14);
}

TEST(SeriesWhitener, AnchoredSeriesGivesEachPosesOwnError) {
  SeriesWhitener series(1, 1);
  double error = 0;
  for (const double step : {0.5, 2.0, -1.0}) {
    error += step;
    MatrixXd row = MatrixXd::Constant(1, 1, step);
    series.Whiten(0.1, row);
    EXPECT_NEAR(row(0, 0), error / 0.1, 1e-13);
  }
}

TEST(SeriesWhitener, DoesNotFeelACommonOffsetOfASeries) {
  Rng rng(2);
  const Series series = MakeSeries(20, 1, false, &rng);
  Matrix3Xd p(3, 20);
  for (double& value : p.reshaped()) value = rng.Normal();
  const Matrix3Xd shifted = p.colwise() + Eigen::Vector3d(0.7, -3, 2);
  // A rounding over sigma 3e-6.
  EXPECT_THAT(Contrasts(series, shifted, 1), MatrixNear(Contrasts(series, p, 1), 1e-9));
}

}  // namespace
}  // namespace dhcal
