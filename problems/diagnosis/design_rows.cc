#include "problems/diagnosis/design_rows.h"

#include <cmath>
#include <map>

#include <glog/logging.h>

#include "core/math/rotation.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

bool IsShared(const Calibration& c) {
  return c.spec.measurement.kind == MeasurementKind::kAdjacentPosition &&
         c.spec.measurement.noise == NoiseKind::kSharedPose;
}

PoseWithDerivatives PoseAt(const Calibration& c, const Eigen::VectorXd& state, int row) {
  PoseWithDerivatives pose;
  c.chain.PoseAndDerivatives(c.recording.q.row(row).transpose(),
                             c.SlotDeltas(state, row),
                             c.frames.ends(c.recording.run(row), c.Target(row)),
                             &pose);
  return pose;
}

}  // namespace

DesignRows::DesignRows(const Calibration& c,
                       const Eigen::VectorXd& state,
                       const Noise& noise,
                       const std::vector<Reading>& readings)
    : c_(c), coordinates_(NumCoordinates(c.spec.measurement.kind)) {
  // A series has one row more than it has differences; at most each difference is a series.
  const auto most =
      static_cast<Eigen::Index>(readings.size()) * coordinates_ * (IsShared(c) ? 2 : 1);
  y_.resize(most);
  now_.resize(most, c.chain.slots().size());
  if (c.spec.measurement.kind == MeasurementKind::kAdjacentPosition && !IsShared(c)) {
    before_.resize(most, c.chain.slots().size());
  }
  if (IsShared(c)) {
    AddSeries(state, readings, noise);
  } else {
    for (const Reading& reading : readings) {
      if (reading.previous_idx >= 0) {
        AddPair(state, reading, noise);
      } else {
        AddPose(state, reading, noise);
      }
    }
  }
  y_.conservativeResize(filled_);
  TakeOutOffsets(&y_);
  now_.conservativeResize(filled_, Eigen::NoChange);
  if (before_.rows() > 0) before_.conservativeResize(filled_, Eigen::NoChange);
}

void DesignRows::Append(const Eigen::VectorXd& y,
                        const Eigen::MatrixXd& now,
                        int row,
                        const Eigen::MatrixXd* before,
                        int before_row) {
  y_.segment(filled_, y.size()) = y;
  now_.middleRows(filled_, y.size()) = now;
  if (before != nullptr) before_.middleRows(filled_, y.size()) = *before;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    now_row_.push_back(row);
    if (before != nullptr) before_row_.push_back(before_row);
  }
  filled_ += static_cast<int>(y.size());
}

void DesignRows::AddPose(const Eigen::VectorXd& state, const Reading& reading, const Noise& noise) {
  const int row = reading.row_idx;
  const PoseWithDerivatives pose = PoseAt(c_, state, row);
  const Comparison comparison = Compare(c_, state, reading);
  const double sigma = c_.RowSigma(row, noise);
  Eigen::VectorXd y = comparison.residual;
  Eigen::MatrixXd J(coordinates_, pose.J_p.cols());
  switch (c_.spec.measurement.kind) {
    case MeasurementKind::kDistance: {
      const Eigen::Vector3d p_AQ = pose.p_WQ - c_.Anchor(row);
      J = p_AQ.normalized().transpose() * pose.J_p;
      break;
    }
    case MeasurementKind::kPose: {
      // Log(R_measured R') grows by -J_r^-1 w when R turns by w; near zero that is -w, and the
      // reading is R itself, which grows by w.
      J.topRows<3>() = pose.J_p;
      J.bottomRows<3>() = LeftJacobianInverseSO3(-y.tail<3>()) * pose.J_w;
      J.bottomRows<3>() /= noise.sigma_rotation;
      y.tail<3>() /= noise.sigma_rotation;
      J.topRows<3>() /= sigma;
      y.head<3>() /= sigma;
      return Append(y, J, row, nullptr, -1);
    }
    case MeasurementKind::kPosition:
    case MeasurementKind::kAdjacentPosition:
      J = pose.J_p;
      break;
  }
  Append(y / sigma, J / sigma, row, nullptr, -1);
}

void DesignRows::AddPair(const Eigen::VectorXd& state, const Reading& reading, const Noise& noise) {
  const double sigma = c_.RowSigma(reading.row_idx, noise);
  const PoseWithDerivatives now = PoseAt(c_, state, reading.row_idx);
  const PoseWithDerivatives before = PoseAt(c_, state, reading.previous_idx);
  const Eigen::VectorXd y = Compare(c_, state, reading).residual / sigma;
  const Eigen::MatrixXd J_now = now.J_p / sigma, J_before = before.J_p / sigma;
  Append(y, J_now, reading.row_idx, &J_before, reading.previous_idx);
}

void DesignRows::AddSeries(const Eigen::VectorXd& state,
                           const std::vector<Reading>& readings,
                           const Noise& noise) {
  struct Last {
    int series = 0;
    Eigen::Vector3d y = Eigen::Vector3d::Zero();  // [m] up to the series' offset
  };
  std::map<int, Last> of_row;
  std::vector<Eigen::Triplet<double>> offsets;
  std::vector<double> length2;  // of each series' offsets
  const auto add = [&](int row, const Last& last) {
    const double sigma = c_.RowSigma(row, noise);
    const PoseWithDerivatives pose = PoseAt(c_, state, row);
    const Eigen::VectorXd y = (last.y - pose.p_WQ) / sigma;
    for (int k = 0; k < 3; ++k) offsets.emplace_back(filled_ + k, 3 * last.series + k, 1 / sigma);
    length2.resize(static_cast<std::size_t>(num_series_));
    length2[static_cast<std::size_t>(last.series)] += 1 / (sigma * sigma);
    Append(y, pose.J_p / sigma, row, nullptr, -1);
    of_row[row] = last;
  };
  for (const Reading& reading : readings) {
    if (of_row.count(reading.previous_idx) == 0) {
      Last first;
      first.series = num_series_++;
      first.y = PoseAt(c_, state, reading.previous_idx).p_WQ;
      add(reading.previous_idx, first);
    }
    Last next = of_row.at(reading.previous_idx);
    next.y += MeasuredDisplacement(c_.recording, reading);
    add(reading.row_idx, next);
  }
  offsets_.resize(filled_, Eigen::Index{3} * num_series_);
  offsets_.setFromTriplets(offsets.begin(), offsets.end());
  for (int k = 0; k < offsets_.cols(); ++k) {
    const double length = std::sqrt(length2[static_cast<std::size_t>(k / 3)]);
    for (Eigen::SparseMatrix<double>::InnerIterator it(offsets_, k); it; ++it) {
      it.valueRef() /= length;
    }
  }
}

Eigen::VectorXd DesignRows::OffsetLeverage() const {
  if (num_series_ == 0) return {};
  Eigen::VectorXd leverage = Eigen::VectorXd::Zero(num_rows());
  for (int k = 0; k < offsets_.cols(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(offsets_, k); it; ++it) {
      leverage[it.row()] += it.value() * it.value();
    }
  }
  return leverage;
}

void DesignRows::WhitenSerially(double rho) {
  CHECK(CanWhiten());
  const double scale = 1 / std::sqrt(1 - rho * rho);
  before_ = Eigen::MatrixXd::Zero(now_.rows(), now_.cols());
  before_row_ = now_row_;
  // From the end, so that the row before is still the original.
  for (int k = num_rows() - 1; k >= coordinates_; --k) {
    const int previous = k - coordinates_;
    const int row = now_row_[static_cast<std::size_t>(k)];
    const int row_before = now_row_[static_cast<std::size_t>(previous)];
    if (c_.recording.run(row) != c_.recording.run(row_before)) continue;
    before_.row(k) = rho * scale * now_.row(previous);
    before_row_[static_cast<std::size_t>(k)] = row_before;
    now_.row(k) *= scale;
    y_[k] = scale * (y_[k] - rho * y_[previous]);
  }
}

Eigen::VectorXd DesignRows::Column(const std::vector<SlotWeights>& slots) const {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(num_rows());
  for (const SlotWeights& weights : slots) {
    for (int k = 0; k < num_rows(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      column[k] += now_(k, weights.slot) * weights.weight[now_row_[i]];
      if (before_.rows() > 0) {
        column[k] -= before_(k, weights.slot) * weights.weight[before_row_[i]];
      }
    }
  }
  TakeOutOffsets(&column);
  return column;
}

Eigen::MatrixXd DesignRows::Geometry(const std::vector<Parameter>& parameters) const {
  const auto num_parameters = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd J(num_rows(), num_parameters);
  for (Eigen::Index k = 0; k < num_parameters; ++k) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(k)];
    if (parameter.effect_column >= 0) {
      const auto column = static_cast<std::size_t>(parameter.effect_column);
      J.col(k) = Column(c_.effect_columns[column].slots);
      continue;
    }
    Eigen::VectorXd weight(c_.recording.num_rows());
    for (int row = 0; row < c_.recording.num_rows(); ++row) {
      weight[row] = InScope(parameter, c_.recording.run(row), c_.Target(row)) ? 1.0 : 0.0;
    }
    J.col(k) = Column({{parameter.slot, weight}});
  }
  return J;
}

double RmsAsRead(const Calibration& c,
                 const Noise& noise,
                 const std::vector<int>& recording_row,
                 const Eigen::VectorXd& whitened) {
  const int coordinates = NumCoordinates(c.spec.measurement.kind);
  double square = 0;
  int count = 0;
  for (Eigen::Index k = 0; k < whitened.size(); ++k) {
    if (k % coordinates >= 3) continue;  // a rotation
    const double sigma = c.RowSigma(recording_row[static_cast<std::size_t>(k)], noise);
    square += whitened[k] * whitened[k] * sigma * sigma;
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : std::nan("");
}

}  // namespace dhcal
