#include "problems/diagnosis/linear_model.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>

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
  constexpr Index kRowsAtOnce = 2048;
  const Index num_columns = model.A.cols();
  const auto num_rows = rows.empty() ? model.A.rows() : static_cast<Index>(rows.size());
  NormalEquations normal{MatrixXd::Zero(num_columns, num_columns), VectorXd::Zero(num_columns)};
  for (Index first = 0; first < num_rows; first += kRowsAtOnce) {
    const Index count = std::min(kRowsAtOnce, num_rows - first);
    MatrixXd A(count, num_columns);
    VectorXd y(count);
    for (Index k = 0; k < count; ++k) {
      const Index row = rows.empty() ? first + k : rows[static_cast<std::size_t>(first + k)];
      A.row(k) = model.A.row(row);
      y[k] = model.y[row];
    }
    normal.H.selfadjointView<Eigen::Lower>().rankUpdate(A.transpose());
    normal.b.noalias() += A.transpose() * y;
  }
  normal.H.triangularView<Eigen::StrictlyUpper>() = normal.H.transpose();
  return normal;
}

VectorXd Solve(const NormalEquations& normal, const std::vector<int>& kept) {
  MatrixXd H = normal.H(kept, kept);
  H.diagonal().array() += 1;
  VectorXd x = VectorXd::Zero(normal.b.size());
  const VectorXd b = normal.b(kept);
  const VectorXd solved = Eigen::LLT<MatrixXd>(H).solve(b);
  x(kept) = solved;
  return x;
}

VectorXd Deviations(const NormalEquations& normal) {
  MatrixXd H = normal.H;
  H.diagonal().array() += 1;
  const MatrixXd inverse = Eigen::LLT<MatrixXd>(H).solve(MatrixXd::Identity(H.rows(), H.cols()));
  return inverse.diagonal().cwiseSqrt();
}

}  // namespace dhcal
