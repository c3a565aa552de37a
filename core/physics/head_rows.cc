#include "core/physics/head_rows.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace dhcal {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// A turn weighs as much as the shift that it makes at this lever, about a head's size.
constexpr double kLever = 0.1;  // [m]
// Spots of two lasers that are closer show no difference of heights.
constexpr double kSpotsApart = 1e-4;  // [m]

/// A simulation has edges before it has readings.
bool ReadsEdge(const Recording& recording, int row_idx) {
  const bool read = recording.head.rows() == 0 || recording.head.row(row_idx).allFinite();
  return read && recording.edge(row_idx) >= 0;
}

bool SpotsCoincide(const HeadSights& sights) {
  return (sights.lasers[1].at - sights.lasers[0].at).norm() < kSpotsApart;
}

/// The motion of Q that changes the numbers by `error`, as perturbation of the base.
Vector6 AsBase(const HeadSights& sights,
               const Eigen::Vector3d& p_BQ_E,
               const Eigen::Vector3d& error) {
  // Heights: the smallest climb, roll and pitch. They leave x free, which the ruler then takes.
  Eigen::Matrix<double, 2, 3> by_tilt;
  for (Eigen::Index k = 0; k < 2; ++k) {
    by_tilt.row(k) = sights.lasers[static_cast<std::size_t>(k)].length_by.segment<3>(2);
  }
  const Eigen::Vector3d weight(1, 1 / (kLever * kLever), 1 / (kLever * kLever));
  const Eigen::Matrix2d normal = by_tilt * weight.asDiagonal() * by_tilt.transpose();
  Vector6 twist = Vector6::Zero();
  twist.segment<3>(2) =
      weight.asDiagonal() * (by_tilt.transpose() * normal.ldlt().solve(error.tail<2>()));
  twist[0] = error[0] - sights.camera.ruler_by.dot(twist);
  const Eigen::Vector3d turn = twist.tail<3>();
  twist.head<3>() -= turn.cross(p_BQ_E);
  return twist;
}

}  // namespace

HeadRows::HeadRows(const PhysicsContext& context) : context_(context) {
  const Recording& recording = context.recording();
  sights_.resize(static_cast<std::size_t>(context.num_rows()));
  const auto edges =
      static_cast<Eigen::Index>(std::max<std::size_t>(recording.edge_names.size(), 1));
  mean_of_edge_ = Eigen::Matrix3Xd::Zero(3, edges);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(edges);
  for (int row = 0; row < context.num_rows(); ++row) {
    if (!ReadsEdge(recording, row)) continue;
    const Eigen::Isometry3d X_EQ = context.X_WQ(row);
    const auto seen = SightsOf(*context.robot().head, X_EQ.translation(), X_EQ.linear());
    if (!seen || SpotsCoincide(*seen)) continue;
    sights_[static_cast<std::size_t>(row)] = seen;
    mean_of_edge_.col(recording.edge(row)) += seen->numbers();
    count[recording.edge(row)] += 1;
  }
  mean_ = mean_of_edge_.rowwise().sum() / std::max(count.sum(), 1.0);
  for (Eigen::Index k = 0; k < edges; ++k) mean_of_edge_.col(k) /= std::max(count[k], 1.0);
}

std::string HeadRows::Missing(const PhysicsContext& context) {
  const Recording& recording = context.recording();
  if (!context.robot().head || recording.edge_idx.empty()) {
    return "no head reads along straight edges";
  }
  const HeadSpec& head = *context.robot().head;
  const Eigen::Vector3d apart = head.lasers[1].p_QS - head.lasers[0].p_QS;
  const bool parallel = head.lasers[0].axis.cross(head.lasers[1].axis).norm() < kSpotsApart;
  if (parallel && apart.cross(head.lasers[0].axis).norm() < kSpotsApart) {
    return "both lasers of the head look along the same line";
  }
  return "";
}

double HeadRows::MeanOfEdge(int row_idx, int number) const {
  return mean_of_edge_(number, context_.recording().edge(row_idx));
}

EffectColumn HeadRows::Column(
    const std::string& parameter,
    const std::string& unit,
    double typical,
    const std::function<Eigen::Vector3d(int row_idx, const HeadSights& sights)>& error) const {
  EffectColumn column;
  column.parameter = parameter;
  column.unit = unit;
  column.typical = typical;
  for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
    column.slots.push_back({context_.slots().base(k), Eigen::VectorXd::Zero(context_.num_rows())});
  }
  for (int row = 0; row < context_.num_rows(); ++row) {
    const HeadSights* const seen = sights(row);
    if (seen == nullptr) continue;
    const Eigen::Vector3d p_BQ_E =
        context_.X_WQ(row).translation() - context_.X_WB(row).translation();
    const Vector6 moved = AsBase(*seen, p_BQ_E, error(row, *seen));
    for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
      column.slots[static_cast<std::size_t>(k)].weight[row] = moved[k];
    }
  }
  return column;
}

EffectDescription EffectOfHead::Describe() const {
  EffectDescription d = Words();
  d.has_joint = false;
  d.of_instrument = true;
  d.of_head = true;
  return d;
}

std::string EffectOfHead::NotTestable(const PhysicsContext& context,
                                      const EffectRequest& /*request*/) const {
  return HeadRows::Missing(context);
}

std::string EffectOfLaser::NotTestable(const PhysicsContext& context,
                                       const EffectRequest& request) const {
  const double laser = request.setting("laser", 0);
  if (laser != 1 && laser != 2) return "needs the setting laser, 1 or 2";
  return HeadRows::Missing(context);
}

std::vector<EffectRequest> EffectOfLaser::Candidates(const PhysicsContext& context) const {
  std::vector<EffectRequest> requests;
  for (const int laser : {1, 2}) {
    requests.push_back(EffectOfHead::Candidates(context).front());
    requests.back().settings["laser"] = laser;
  }
  return requests;
}

int LaserIndex(const EffectRequest& request) {
  return static_cast<int>(request.setting("laser", 1)) - 1;
}

}  // namespace dhcal
