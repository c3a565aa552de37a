#include "problems/diagnosis/linear_model.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "core/base/parallel.h"
#include "problems/assembly.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearModel::LinearModel(const Calibration& c, const VectorXd& state, const Noise& noise)
    : tolerance(ScalesOf(c.parameters).tolerance) {
  const DesignRows rows(c, state, noise, c.readings.fitted);
  recording_row = rows.now_row();
  y = rows.y();
  A = rows.Geometry(c.parameters);
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const auto i = static_cast<Index>(k);
    if (c.parameters[k].effect_column >= 0) y += A.col(i) * state[i];
    A.col(i) *= tolerance[i];
  }
}

NormalEquations NormalEquationsOf(const LinearModel& model, const std::vector<int>& rows) {
  constexpr std::size_t kRowsAtOnce = 2048;
  constexpr int kParts = 4;
  const Index num_columns = model.A.cols();
  std::vector<int> used = rows;
  if (used.empty()) {
    used.resize(static_cast<std::size_t>(model.A.rows()));
    std::iota(used.begin(), used.end(), 0);
  }
  // With y as one more column its products come along.
  std::vector<MatrixXd> of_part(kParts, MatrixXd::Zero(num_columns + 1, num_columns + 1));
  ParallelFor(kParts, [&](int part) {
    const auto i = static_cast<std::size_t>(part);
    const std::size_t end = used.size() * (i + 1) / kParts;
    for (std::size_t first = used.size() * i / kParts; first < end; first += kRowsAtOnce) {
      const std::vector<int> some(
          used.begin() + static_cast<long>(first),
          used.begin() + static_cast<long>(std::min(first + kRowsAtOnce, end)));
      MatrixXd rows_and_y(static_cast<Index>(some.size()), num_columns + 1);
      rows_and_y << model.A(some, Eigen::all), model.y(some);
      of_part[i].selfadjointView<Eigen::Lower>().rankUpdate(rows_and_y.transpose());
    }
  });
  MatrixXd products =
      std::accumulate(of_part.begin() + 1,
                      of_part.end(),
                      of_part.front(),
                      [](const MatrixXd& a, const MatrixXd& b) { return MatrixXd(a + b); });
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return {products.topLeftCorner(num_columns, num_columns),
          products.col(num_columns).head(num_columns)};
}

VectorXd Solve(const NormalEquations& normal, const std::vector<int>& kept, double variance) {
  MatrixXd H = normal.H(kept, kept);
  H.diagonal().array() += variance;
  VectorXd x = VectorXd::Zero(normal.b.size());
  const VectorXd b = normal.b(kept);
  const VectorXd solved = Eigen::LLT<MatrixXd>(H).solve(b);
  x(kept) = solved;
  return x;
}

MatrixXd Covariance(MatrixXd H) {
  H.diagonal().array() += 1;
  return Eigen::LLT<MatrixXd>(H).solve(MatrixXd::Identity(H.rows(), H.cols()));
}

}  // namespace dhcal
