#include "problems/diagnosis/design_rows.h"

#include <cmath>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <glog/logging.h>

#include "core/math/products.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

// Of the largest variance: what is less is rounding.
constexpr double kLeastVariance = 1e-12;

double Square(double x) { return x * x; }

bool IsShared(const Calibration& c) {
  return c.measurement->kind().pairs && c.spec.measurement.noise == NoiseKind::kSharedPose;
}

/// Derivative of a reading by all slots of a pose, from that by the pose's twist.
Eigen::MatrixXd BySlots(const ReadingComparison::TwistRows& by_twist,
                        const PoseWithDerivatives& pose) {
  return by_twist.leftCols<3>() * pose.J_p + by_twist.rightCols<3>() * pose.J_w;
}

bool Turns(const Calibration& c, int joint) {
  return c.spec.robot.joints[static_cast<std::size_t>(joint)].type == JointType::kRevolute;
}

/// Slot that a joint's coordinate is added to.
int MovingSlot(const Calibration& c, int joint) {
  return c.chain.slots().joint(joint, Turns(c, joint) ? JointSlot::kTheta : JointSlot::kD);
}

/// Standard deviation of each coordinate of a row's reading; 1 where rows are to be as read.
Eigen::VectorXd Sigmas(const Calibration& c, const RowWeights& weights, int row) {
  const std::vector<MeasuredCoordinate>& coordinates = c.measurement->kind().coordinates;
  const Noise& noise = weights.noise;
  Eigen::VectorXd sigma = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(coordinates.size()));
  if (weights.as_read) return sigma;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const bool length = coordinates[k].unit == Unit::kMetre;
    sigma[static_cast<Eigen::Index>(k)] =
        coordinates[k].noise * (length ? c.RowSigma(row, noise) : noise.sigma_rotation);
  }
  return sigma;
}

/// Rows in standard deviations: divided by the square root of `extra` + diag(sigma^2), times root.
void Whiten(const Eigen::MatrixXd& extra,
            const Eigen::VectorXd& sigma,
            double root,
            Eigen::VectorXd* y,
            Eigen::MatrixXd* J) {
  if (extra.isZero(0)) {
    const Eigen::VectorXd scale = root * sigma.cwiseInverse();
    *y = scale.cwiseProduct(*y);
    *J = scale.asDiagonal() * *J;
    return;
  }
  Eigen::MatrixXd covariance = extra;
  covariance.diagonal() += sigma.cwiseAbs2();
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  *y = root * factor.matrixL().solve(*y);
  *J = root * factor.matrixL().solve(*J);
}

/// What a state adds to the slots of the rows that are read.
Eigen::MatrixXd DeltasAt(const Calibration& c,
                         const Eigen::VectorXd& state,
                         const std::vector<Reading>& readings) {
  Eigen::MatrixXd deltas = Eigen::MatrixXd::Zero(c.chain.slots().size(), c.recording.num_rows());
  for (const Reading& reading : readings) {
    deltas.col(reading.row_idx) = c.SlotDeltas(state, reading.row_idx);
    if (reading.previous_idx >= 0) {
      deltas.col(reading.previous_idx) = c.SlotDeltas(state, reading.previous_idx);
    }
  }
  return deltas;
}

RowWeights WithNoise(const Noise& noise) {
  RowWeights weights;
  weights.noise = noise;
  return weights;
}

}  // namespace

DesignRows::DesignRows(const Calibration& c,
                       const Eigen::VectorXd& state,
                       const Noise& noise,
                       const std::vector<Reading>& readings)
    : DesignRows(c, DeltasAt(c, state, readings), WithNoise(noise), readings) {}

DesignRows::DesignRows(const Calibration& c,
                       const Eigen::MatrixXd& deltas,
                       const RowWeights& weights,
                       const std::vector<Reading>& readings)
    : c_(c),
      deltas_(deltas),
      weights_(weights),
      coordinates_(c.measurement->kind().num_coordinates()) {
  // A series has one row more than it has differences; at most each difference is a series.
  const auto most =
      static_cast<Eigen::Index>(readings.size()) * coordinates_ * (IsShared(c) ? 2 : 1);
  y_.resize(most);
  now_.resize(most, c.chain.slots().size());
  if (c.measurement->kind().pairs && !IsShared(c)) {
    before_.resize(most, c.chain.slots().size());
  }
  if (IsShared(c)) {
    AddSeries(readings);
  } else {
    for (const Reading& reading : readings) AddReading(reading);
  }
  y_.conservativeResize(filled_);
  TakeOutOffsets(&y_);
  now_.conservativeResize(filled_, Eigen::NoChange);
  if (before_.rows() > 0) before_.conservativeResize(filled_, Eigen::NoChange);
  if (!weights.slow.none()) TakeOutSlowNoise();
  shared_.resize(filled_, 0);
  ShrinkSharedRounding();
}

PoseWithDerivatives DesignRows::PoseAt(int row) const {
  PoseWithDerivatives pose;
  c_.chain.PoseAndDerivatives(
      c_.recording.q.row(row).transpose(), deltas_.col(row), c_.frames.ends(c_.Labels(row)), &pose);
  return pose;
}

double DesignRows::RootWeight(int row) const {
  return weights_.weight.size() == 0 ? 1.0 : std::sqrt(weights_.weight[row]);
}

Eigen::MatrixXd DesignRows::OfTheJoints(const Eigen::MatrixXd& J) const {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(J.rows(), J.rows());
  const Eigen::VectorXd& quantum = weights_.read_out.quantum;
  for (int joint = 0; joint < c_.recording.num_joints(); ++joint) {
    double variance = joint < quantum.size() ? Square(quantum[joint]) / 12 : 0;
    if (Turns(c_, joint)) variance += Square(weights_.joint_noise);
    if (variance == 0) continue;
    const Eigen::VectorXd column = J.col(MovingSlot(c_, joint));
    covariance += variance * column * column.transpose();
  }
  return covariance;
}

Eigen::MatrixXd DesignRows::ByJoints() const {
  std::vector<int> slots;
  for (int joint = 0; joint < c_.recording.num_joints(); ++joint) {
    slots.push_back(MovingSlot(c_, joint));
  }
  const auto joints = static_cast<Eigen::Index>(slots.size());
  Eigen::MatrixXd by_joints(num_rows(), before_.rows() > 0 ? 2 * joints : joints);
  by_joints.leftCols(joints) = now_(Eigen::all, slots);
  if (before_.rows() > 0) by_joints.rightCols(joints) = before_(Eigen::all, slots);
  return by_joints;
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

void DesignRows::AddReading(const Reading& reading) {
  const bool pair = reading.previous_idx >= 0;
  const PoseWithDerivatives now = PoseAt(reading.row_idx);
  const PoseWithDerivatives before = PoseAt(pair ? reading.previous_idx : reading.row_idx);
  const SeenPose seen{now.p_WQ, now.R_WQ}, seen_before{before.p_WQ, before.R_WQ};
  ReadingComparison comparison(coordinates_);
  // Where it has no derivative (a wire of no length) the row stays zero and tells nothing.
  c_.measurement->Compare(reading, seen, pair ? &seen_before : nullptr, &comparison);
  Eigen::VectorXd y = -comparison.difference;
  // The reading grows with the pose before by minus its column.
  const Eigen::Index slots = now.J_p.cols();
  Eigen::MatrixXd J(coordinates_, (before_.rows() > 0 ? 2 : 1) * slots);
  J.leftCols(slots) = BySlots(comparison.by_now, now);
  Eigen::MatrixXd of_joints = OfTheJoints(J.leftCols(slots));
  if (before_.rows() > 0) {
    J.rightCols(slots) = -BySlots(comparison.by_before, before);
    of_joints += OfTheJoints(J.rightCols(slots));
  }
  const Eigen::VectorXd sigma = Sigmas(c_, weights_, reading.row_idx);
  Whiten(of_joints, sigma, RootWeight(reading.row_idx), &y, &J);
  if (before_.rows() == 0) return Append(y, J, reading.row_idx, nullptr, -1);
  const Eigen::MatrixXd J_before = J.rightCols(slots);
  Append(y,
         J.leftCols(slots),
         reading.row_idx,
         &J_before,
         pair ? reading.previous_idx : reading.row_idx);
}

void DesignRows::AddSeries(const std::vector<Reading>& readings) {
  struct Last {
    int series = -1;        // none: anchored, without an offset
    Eigen::VectorXd error;  // measured minus predicted, up to the series' offset
    Eigen::MatrixXd J;      // of the row's own reading, by slots
  };
  std::map<int, Last> of_row;
  std::vector<Eigen::Triplet<double>> offsets;
  std::vector<double> length2;  // of each offset
  const auto add = [&](int row, const Last& last) {
    // One number per row, so that what the offsets take stays a mean of rows.
    const double of_joints = OfTheJoints(last.J).trace() / coordinates_;
    const Eigen::VectorXd sigma =
        (Sigmas(c_, weights_, row).array().square() + of_joints).sqrt() / RootWeight(row);
    if (last.series >= 0) {
      length2.resize(static_cast<std::size_t>(coordinates_) *
                     static_cast<std::size_t>(num_series_));
      for (int k = 0; k < coordinates_; ++k) {
        const int offset = coordinates_ * last.series + k;
        offsets.emplace_back(filled_ + k, offset, 1 / sigma[k]);
        length2[static_cast<std::size_t>(offset)] += 1 / (sigma[k] * sigma[k]);
      }
    }
    Append(last.error.cwiseQuotient(sigma),
           sigma.cwiseInverse().asDiagonal() * last.J,
           row,
           nullptr,
           -1);
    of_row[row] = last;
  };
  for (const Reading& reading : readings) {
    const PoseWithDerivatives now = PoseAt(reading.row_idx);
    const SeenPose seen{now.p_WQ, now.R_WQ};
    ReadingComparison comparison(coordinates_);
    if (reading.previous_idx < 0) {
      c_.measurement->Compare(reading, seen, nullptr, &comparison);
      add(reading.row_idx, {-1, -comparison.difference, BySlots(comparison.by_now, now)});
      continue;
    }
    const PoseWithDerivatives before = PoseAt(reading.previous_idx);
    const SeenPose seen_before{before.p_WQ, before.R_WQ};
    c_.measurement->Compare(reading, seen, &seen_before, &comparison);
    if (of_row.count(reading.previous_idx) == 0) {
      // The earlier reading of a pair enters with the other sign.
      add(reading.previous_idx,
          {num_series_++,
           Eigen::VectorXd::Zero(coordinates_),
           -BySlots(comparison.by_before, before)});
    }
    Last next = of_row.at(reading.previous_idx);
    next.error -= comparison.difference;
    next.J = BySlots(comparison.by_now, now);
    add(reading.row_idx, next);
  }
  offsets_.resize(filled_, Eigen::Index{coordinates_} * num_series_);
  offsets_.setFromTriplets(offsets.begin(), offsets.end());
  for (int k = 0; k < offsets_.cols(); ++k) {
    const double length = std::sqrt(length2[static_cast<std::size_t>(k)]);
    for (Eigen::SparseMatrix<double>::InnerIterator it(offsets_, k); it; ++it) {
      it.valueRef() /= length;
    }
  }
}

ReadingOrder DesignRows::Order() const {
  ReadingOrder order;
  order.coordinates = coordinates_;
  int sequence = 0;
  for (int reading = 0; reading < num_readings(); ++reading) {
    const int row = recording_row(reading);
    const bool first = order.place.empty() || row < order.place.back() ||
                       c_.recording.run(row) != c_.recording.run(order.place.back());
    if (first) ++sequence;
    order.sequence.push_back(sequence);
    order.place.push_back(row);
  }
  return order;
}

void DesignRows::TakeOutSlowNoise() {
  CHECK(CanWhiten(c_));
  slow_.emplace(weights_.slow, Order());
  slow_->Whiten(y_);
}

void DesignRows::ShrinkSharedRounding() {
  std::vector<std::vector<SlotWeights>> places_of_all;  // one standard deviation of each
  for (int joint = 0; joint < weights_.read_out.level.size(); ++joint) {
    const double quantum = weights_.read_out.level[joint];
    if (quantum == 0) continue;
    std::map<long long, Eigen::VectorXd> places;
    for (int row = 0; row < c_.recording.num_rows(); ++row) {
      const auto place = places.emplace(std::llround(c_.recording.q(row, joint) / quantum),
                                        Eigen::VectorXd::Zero(c_.recording.num_rows()));
      place.first->second[row] = quantum / std::sqrt(12.0);
    }
    for (const auto& place : places) {
      places_of_all.push_back({{MovingSlot(c_, joint), place.second}});
    }
  }
  if (places_of_all.empty()) return;
  const Eigen::MatrixXd L = OwnColumns(places_of_all);
  // Covariance I + L L' = I + U S^2 U', and its inverse root is I - U (1 - (1 + S^2)^-1/2) U'.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(SquareOf(L));
  const double least = kLeastVariance * eigen.eigenvalues().maxCoeff();
  Eigen::Index first = 0;
  while (first < L.cols() && eigen.eigenvalues()[first] <= least) ++first;
  const Eigen::VectorXd variance = eigen.eigenvalues().tail(L.cols() - first);
  shared_ = L * (eigen.eigenvectors().rightCols(variance.size()) *
                 variance.cwiseSqrt().cwiseInverse().asDiagonal());
  shrunk_ = 1 - (1 + variance.array()).rsqrt();
  y_ = Shrunk(y_);
}

Eigen::MatrixXd DesignRows::Shrunk(const Eigen::MatrixXd& V) const {
  if (shared_.cols() == 0) return V;
  return Deducted(V, shared_, shrunk_.asDiagonal() * TransposedProduct(shared_, V));
}

Eigen::VectorXd DesignRows::Column(const std::vector<SlotWeights>& slots) const {
  return Shrunk(OwnColumn(slots));
}

Eigen::VectorXd DesignRows::OwnColumn(const std::vector<SlotWeights>& slots) const {
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
  if (slow_) slow_->Whiten(column);
  return column;
}

Eigen::MatrixXd DesignRows::OwnColumns(const std::vector<std::vector<SlotWeights>>& columns) const {
  Eigen::MatrixXd whitened(num_rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    whitened.col(static_cast<Eigen::Index>(k)) = OwnColumn(columns[k]);
  }
  return whitened;
}

Eigen::MatrixXd DesignRows::Columns(const std::vector<std::vector<SlotWeights>>& columns) const {
  return Shrunk(OwnColumns(columns));
}

Eigen::MatrixXd DesignRows::Geometry(const std::vector<Parameter>& parameters) const {
  std::vector<std::vector<SlotWeights>> columns;
  for (const Parameter& parameter : parameters) {
    if (parameter.effect_column >= 0) {
      columns.push_back(c_.ColumnOf(parameter).slots);
      continue;
    }
    Eigen::VectorXd weight(c_.recording.num_rows());
    for (int row = 0; row < c_.recording.num_rows(); ++row) {
      weight[row] = parameter.scope.Holds(c_.Labels(row)) ? 1.0 : 0.0;
    }
    columns.push_back({{parameter.slot, weight}});
  }
  return Columns(columns);
}

double RmsAsRead(const Calibration& c,
                 const Noise& noise,
                 const std::vector<int>& recording_row,
                 const Eigen::VectorXd& whitened) {
  const MeasurementKind& kind = c.measurement->kind();
  double square = 0;
  int count = 0;
  for (Eigen::Index k = 0; k < whitened.size(); ++k) {
    const auto coordinate = static_cast<std::size_t>(k % kind.num_coordinates());
    if (kind.coordinates[coordinate].unit != Unit::kMetre) continue;
    const double sigma = kind.coordinates[coordinate].noise *
                         c.RowSigma(recording_row[static_cast<std::size_t>(k)], noise);
    square += whitened[k] * whitened[k] * sigma * sigma;
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : std::nan("");
}

}  // namespace dhcal
