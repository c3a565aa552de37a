#include "problems/diagnosis/elsewhere.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/assembly.h"
#include "problems/diagnosis/projection.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kUnseenPoses = 300;
constexpr double kHalfRange = 120 * kDegree;
constexpr double kDetection = 27;  // non-centrality found with 90 % at 1e-4 (PHYSICS.md M5)
// An effect's prior sigma in typical sizes: wide, so that the data limit the risk and not what is
// usual; it only bounds what no row of the recording shows.
constexpr double kTypicalToPrior = 10;
constexpr double kOtherPayload = 15;  // [kg]
constexpr std::size_t kMostPoses = 8;

bool DependsOnPoseOnly(const EffectRequest& request) {
  return FindEffect(request.effect)->DependsOnPoseOnly(request);
}

/// Those that move a slot of their own.
std::vector<Parameter> OfSlots(const std::vector<Parameter>& parameters) {
  std::vector<Parameter> of_slots;
  std::copy_if(
      parameters.begin(), parameters.end(), std::back_inserter(of_slots), [](const Parameter& p) {
        return p.effect_column < 0;
      });
  return of_slots;
}

}  // namespace

Recording PosesElsewhere(const Recording& recording, const RobotModel& robot, int count) {
  Rng rng(77);
  Recording poses;
  poses.q.resize(count, recording.num_joints());
  for (int j = 0; j < recording.num_joints(); ++j) {
    const double low = recording.q.col(j).minCoeff(), high = recording.q.col(j).maxCoeff();
    const bool revolute = robot.joints[static_cast<std::size_t>(j)].type == JointType::kRevolute;
    const double half =
        revolute ? std::max((high - low) / 2, kHalfRange) : std::max(high - low, 0.1);
    const double middle = (low + high) / 2;
    for (int k = 0; k < count; ++k) poses.q(k, j) = rng.Uniform(middle - half, middle + half);
  }
  std::vector<double> carried;
  for (const double payload : recording.payload) {
    if (std::isfinite(payload)) carried.push_back(payload);
  }
  if (!carried.empty()) poses.payload = VectorXd::Constant(count, Median(carried));
  return poses;
}

Elsewhere::Elsewhere(const Calibration& calibration,
                     const VectorXd& state,
                     const PhysicsContext& context,
                     const DesignRows& rows,
                     const std::vector<Parameter>& geometry)
    : c_(calibration),
      state_(state),
      context_(context),
      rows_(rows),
      geometry_(OfSlots(geometry)),
      tolerance_(ScalesOf(geometry_).tolerance),
      poses_(PosesElsewhere(calibration.recording, calibration.spec.robot, kUnseenPoses)) {
  J_ = rows.Geometry(geometry_) * tolerance_.asDiagonal();
  MatrixXd normal = J_.transpose() * J_;
  normal.diagonal().array() += 1;
  normal_ = normal.llt().solve(MatrixXd::Identity(normal.rows(), normal.cols()));
}

MatrixXd Elsewhere::Raw(const EffectRequest& request) const {
  const std::vector<EffectColumn> columns = EffectColumns(context_, request);
  MatrixXd raw(rows_.num_rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    raw.col(static_cast<Index>(k)) = columns[k].typical * rows_.Column(columns[k].slots);
  }
  return raw;
}

MatrixXd Elsewhere::Absorbed(const MatrixXd& columns) const {
  return tolerance_.asDiagonal() * (normal_ * (J_.transpose() * columns));
}

MatrixXd Elsewhere::Moves(const EffectRequest& request,
                          const MatrixXd& absorbed,
                          const Recording& poses) const {
  const PhysicsContext there(c_.spec.robot, poses, {c_.frames.base({})});
  // The recording's columns in their sizes: elsewhere the typical size may be another, and a column
  // may be missing (of the payload, where it does not vary), or have come in.
  const std::vector<EffectColumn> here = EffectColumns(context_, request);
  const std::vector<EffectColumn> columns = EffectColumns(there, request);
  MatrixXd moves(3 * poses.num_rows(), static_cast<Index>(here.size()));
  PoseWithDerivatives pose;
  for (int row = 0; row < poses.num_rows(); ++row) {
    c_.chain.PoseAndDerivatives(
        poses.q.row(row).transpose(), c_.SlotDeltas(state_, 0), c_.frames.ends({}), &pose);
    for (std::size_t k = 0; k < here.size(); ++k) {
      Eigen::Vector3d move = Eigen::Vector3d::Zero();
      for (const EffectColumn& column : columns) {
        if (column.parameter != here[k].parameter) continue;
        for (const SlotWeights& weights : column.slots) {
          move += here[k].typical * weights.weight[row] * pose.J_p.col(weights.slot);
        }
      }
      for (std::size_t g = 0; g < geometry_.size(); ++g) {
        if (!geometry_[g].scope.Holds({})) continue;
        move -= pose.J_p.col(geometry_[g].slot) *
                absorbed(static_cast<Index>(g), static_cast<Index>(k));
      }
      moves.block<3, 1>(3 * row, static_cast<Index>(k)) = move;
    }
  }
  return moves;
}

HiddenRisk Elsewhere::Risk(const EffectRequest& request,
                           const MatrixXd& basis,
                           const VectorXd& y,
                           double sigma_scale) const {
  HiddenRisk risk;
  risk.effect = request;
  const std::vector<EffectColumn> columns = EffectColumns(context_, request);
  risk.unit = columns.front().unit;
  const MatrixXd raw = Raw(request);
  const MatrixXd X = ProjectOff(basis, raw);
  const double seen = X.col(0).norm();
  risk.visibility = raw.col(0).norm() > 0 ? seen / raw.col(0).norm() : 0;
  if (risk.visibility > 1e-3) {
    risk.limit = sigma_scale * std::sqrt(kDetection) / seen * columns.front().typical;
  }
  if (!DependsOnPoseOnly(request)) return risk;
  // The effect's size with the geometry free, and a prior of a few typical sizes.
  MatrixXd precision = X.transpose() * X / (sigma_scale * sigma_scale);
  precision.diagonal().array() += 1 / (kTypicalToPrior * kTypicalToPrior);
  const MatrixXd covariance =
      precision.llt().solve(MatrixXd::Identity(precision.rows(), precision.cols()));
  const VectorXd size = covariance * (X.transpose() * y) / (sigma_scale * sigma_scale);
  const MatrixXd moves = Moves(request, Absorbed(raw), poses_);
  risk.risk = 0;
  for (int row = 0; row < poses_.num_rows(); ++row) {
    const MatrixXd D = moves.middleRows(3 * row, 3);
    const Eigen::Matrix3d spread = D * covariance * D.transpose();
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues().maxCoeff();
    risk.risk = std::max(risk.risk, (D * size).norm() + 1.96 * std::sqrt(std::max(largest, 0.0)));
  }
  return risk;
}

Elsewhere::Split Elsewhere::PosesThatSplit(const EffectRequest& first,
                                           const VectorXd& value,
                                           const EffectRequest& second) const {
  Split split;
  if (!DependsOnPoseOnly(first) || !DependsOnPoseOnly(second)) return split;
  const std::vector<EffectColumn> columns = EffectColumns(context_, first);
  VectorXd size(value.size());
  for (Index k = 0; k < size.size(); ++k) {
    size[k] = value[k] / columns[static_cast<std::size_t>(k)].typical;
  }
  // The best imitation by the second, beside what the geometry takes of both.
  const MatrixXd raw1 = Raw(first), raw2 = Raw(second);
  const MatrixXd taken = tolerance_.cwiseInverse().asDiagonal() * Absorbed(raw2);
  const MatrixXd seen2 = raw2 - J_ * taken;
  const VectorXd moved1 = raw1 * size;
  const VectorXd seen1 = moved1 - J_ * (normal_ * (J_.transpose() * moved1));
  const VectorXd imitation = seen2.completeOrthogonalDecomposition().solve(seen1);
  const MatrixXd absorbed = Absorbed(moved1 - raw2 * imitation);
  const auto difference = [&](const Recording& poses) {
    const MatrixXd none = MatrixXd::Zero(tolerance_.size(), std::max(raw1.cols(), raw2.cols()));
    VectorXd moved = Moves(first, none, poses) * size - Moves(second, none, poses) * imitation;
    PoseWithDerivatives pose;
    for (int row = 0; row < poses.num_rows(); ++row) {
      c_.chain.PoseAndDerivatives(
          poses.q.row(row).transpose(), c_.SlotDeltas(state_, 0), c_.frames.ends({}), &pose);
      for (std::size_t g = 0; g < geometry_.size(); ++g) {
        if (!geometry_[g].scope.Holds({})) continue;
        moved.segment<3>(3 * row) -=
            pose.J_p.col(geometry_[g].slot) * absorbed(static_cast<Index>(g), 0);
      }
    }
    VectorXd length(poses.num_rows());
    for (int row = 0; row < poses.num_rows(); ++row) length[row] = moved.segment<3>(3 * row).norm();
    return length;
  };
  const VectorXd length = difference(poses_);
  std::vector<int> order(static_cast<std::size_t>(length.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return length[a] > length[b]; });
  split.largest = length.maxCoeff();
  for (std::size_t k = 0; k < order.size() && k < kMostPoses; ++k) {
    split.poses.push_back({poses_.q.row(order[k]).transpose(), kUnknown});
  }
  // Each pose twice: empty and loaded.
  const int count = std::min(c_.recording.num_rows(), kUnseenPoses);
  Recording pairs;
  pairs.q = c_.recording.q.topRows(count).replicate(2, 1);
  pairs.payload.setZero(2 * Index{count});
  pairs.payload.tail(count).setConstant(kOtherPayload);
  const VectorXd apart = difference(pairs);
  split.with_payload = (apart.tail(count) - apart.head(count)).cwiseAbs().maxCoeff();
  return split;
}

}  // namespace dhcal
