#include "problems/edge_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "core/base/units.h"
#include "core/kinematics/slots.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// Spots that spread less across the edge [m] tell a robot's errors rather than the face's tilt.
constexpr double kLeastSpread = 5 * kMillimetre;
// Readings that grow by less over all rows [m] show no direction.
constexpr double kLeastTravel = 1 * kMillimetre;

/// Directions in which points spread, in columns, least first, and how far (RMS) [m].
struct Spread {
  Vector3d mean, along;
  Eigen::Matrix3d axes;
};

Spread SpreadOfPoints(const Matrix3Xd& points) {
  Spread spread;
  spread.mean = points.rowwise().mean();
  const Matrix3Xd centred = points.colwise() - spread.mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(centred * centred.transpose() /
                                                             static_cast<double>(points.cols()));
  spread.along = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  spread.axes = eigen.eigenvectors();
  return spread;
}

/// Spots of both lasers in B, and the mean of their sights.
Matrix3Xd LaserSpots(const HeadSpec& head, const EdgeRows& rows, Vector3d* sight) {
  Matrix3Xd spots(3, 2 * static_cast<Eigen::Index>(rows.X_BQ.size()));
  sight->setZero();
  Eigen::Index at = 0;
  for (std::size_t row = 0; row < rows.X_BQ.size(); ++row) {
    for (std::size_t k = 0; k < head.lasers.size(); ++k) {
      const HeadSensor& laser = head.lasers[k];
      const double height = rows.numbers[row][static_cast<Eigen::Index>(k) + 1];
      spots.col(at++) = rows.X_BQ[row] * Vector3d(laser.p_QS + height * laser.axis);
      *sight += rows.X_BQ[row].linear() * laser.axis;
    }
  }
  sight->normalize();
  return spots;
}

/// Where the camera's sight meets the plane n . p = c, at every row; a sight along it gives NaN or
/// infinity.
Matrix3Xd CameraSpots(const HeadSpec& head, const EdgeRows& rows, const Vector3d& n, double c) {
  Matrix3Xd spots(3, static_cast<Eigen::Index>(rows.X_BQ.size()));
  for (std::size_t row = 0; row < rows.X_BQ.size(); ++row) {
    const Vector3d from = rows.X_BQ[row] * head.camera.p_QS;
    const Vector3d u = rows.X_BQ[row].linear() * head.camera.axis;
    spots.col(static_cast<Eigen::Index>(row)) = from + (c - n.dot(from)) / n.dot(u) * u;
  }
  return spots;
}

/// Unit vector in the plane along which readings at these spots grow.
std::optional<Vector3d> GrowthAlong(const Matrix3Xd& spots,
                                    const Eigen::VectorXd& readings,
                                    const Vector3d& n) {
  const Eigen::MatrixXd in_plane = (Eigen::Matrix3d::Identity() - n * n.transpose()) *
                                   (spots.colwise() - spots.rowwise().mean());
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(in_plane.transpose(),
                                        Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double most = svd.singularValues()[0];
  if (!(most > kLeastTravel)) return std::nullopt;
  const double least = kLeastSpread * std::sqrt(static_cast<double>(spots.cols()));
  svd.setThreshold(std::min(least / most, 0.5));
  const Vector3d growth = svd.solve((readings.array() - readings.mean()).matrix());
  if (!(growth.norm() > 0) || !growth.allFinite()) return std::nullopt;
  return growth.normalized();
}

/// True where the file gives the edge's pose and holds some of what readings show of it.
bool IsHeld(const Calibration& c, int edge) {
  const std::string& name = c.recording.edge_names[static_cast<std::size_t>(edge)];
  const bool given = std::any_of(c.spec.robot.edges.begin(),
                                 c.spec.robot.edges.end(),
                                 [&](const Edge& e) { return e.name == name && e.X_WE; });
  if (!given) return false;
  std::array<bool, SlotLayout::kPerFrame> held;
  held.fill(true);
  for (const Parameter& p : c.parameters) {
    if (p.group != ParameterGroup::kBase || p.scope.row().edge != edge || p.prior_sigma) continue;
    held[static_cast<std::size_t>(p.slot - c.chain.slots().base(0))] = false;
  }
  for (const HiddenFreedom& hidden : c.measurement->kind().hidden) {
    held[static_cast<std::size_t>(hidden.base_component)] = false;
  }
  return std::find(held.begin(), held.end(), true) != held.end();
}

EdgeRows RowsOfEdge(const Calibration& c, int edge) {
  std::set<int> rows;
  for (const Reading& reading : c.readings.fitted) {
    if (c.recording.edge(reading.row_idx) != edge) continue;
    rows.insert(reading.row_idx);
    if (reading.previous_idx >= 0) rows.insert(reading.previous_idx);
  }
  EdgeRows of_edge;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(c.chain.slots().size());
  for (const int row : rows) {
    of_edge.X_BQ.push_back(c.chain.FlangePose(c.recording.q.row(row).transpose(), none) *
                           c.frames.tool(c.Labels(row)));
    of_edge.numbers.emplace_back(c.recording.head.row(row).transpose());
  }
  return of_edge;
}

}  // namespace

std::optional<Isometry3d> AlignEdge(const HeadSpec& head, const EdgeRows& rows) {
  if (rows.X_BQ.size() < 2) return std::nullopt;
  Vector3d sight;
  const Spread spots = SpreadOfPoints(LaserSpots(head, rows, &sight));
  const Vector3d longest = spots.axes.col(2);
  const bool flat = spots.along[1] > kLeastSpread;
  Vector3d n = flat ? Vector3d(spots.axes.col(0)) : Vector3d(sight - longest * longest.dot(sight));
  n *= n.dot(sight) > 0 ? -1 / n.norm() : 1 / n.norm();
  const double face = n.dot(spots.mean);
  const Matrix3Xd camera = CameraSpots(head, rows, n, face + head.ruler_height);
  if (!camera.allFinite()) return std::nullopt;
  Eigen::VectorXd readings(camera.cols());
  for (Eigen::Index k = 0; k < readings.size(); ++k) {
    readings[k] = rows.numbers[static_cast<std::size_t>(k)][0];
  }
  const std::optional<Vector3d> x = GrowthAlong(camera, readings, n);
  if (!x) return std::nullopt;
  const Vector3d y = n.cross(*x), mean = camera.rowwise().mean();
  Isometry3d X_BE = Isometry3d::Identity();
  X_BE.linear() << *x, y, n;
  X_BE.translation() = X_BE.linear() * Vector3d(x->dot(mean) - readings.mean(), y.dot(mean), face);
  return X_BE;
}

void AlignEdges(Calibration* c) {
  const auto num_edges = static_cast<int>(c->recording.edge_names.size());
  for (int edge = 0; edge < num_edges; ++edge) {
    if (IsHeld(*c, edge)) continue;
    const std::optional<Isometry3d> X_BE =
        AlignEdge(c->spec.measurement.head, RowsOfEdge(*c, edge));
    if (X_BE) c->frames.mutable_base({0, 0, edge}) = X_BE->inverse();
  }
}

}  // namespace dhcal
