// A displacement between two adjacent poses.
//
//   h(X, X_before) = p_WQ - p_WQ,before   displacement of the measured point Q in W [m]
//
// Read as such (columns dx, dy, dz), or as the difference of two position readings; then a pose's
// error enters both of its differences, which `noise: shared_pose` whitens exactly
// (residuals/series.h). A first pose that is anchored is read by itself: h = p_WQ.
// Differentiable everywhere. English et al. (2004), step 1 of the nine.
#include <algorithm>
#include <limits>

#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

constexpr char kDisplacementColumns[] = "dx_mm, dy_mm, dz_mm (or _m)";

class AdjacentPosition final : public Measurement {
 public:
  using Measurement::Measurement;

  std::string Missing() const override {
    if (HasDisplacements()) {
      return MissingColumns(kind(), {{kDisplacementColumns, recording().displacement}});
    }
    if (recording().p_WQ.rows() == 0) {
      return NeedsColumns(kind(), std::string(kPositionColumns) + " or " + kDisplacementColumns);
    }
    return MissingColumns(kind(), {{kPositionColumns, recording().p_WQ}});
  }
  bool HasReading(int row_idx) const override {
    return Present(HasDisplacements() ? recording().displacement : recording().p_WQ, row_idx);
  }
  /// Displacements lead from row to row; of positions a blank one is skipped.
  bool CanPrecede(int row_idx) const override {
    return HasDisplacements() || Present(recording().p_WQ, row_idx);
  }
  bool Compare(const Reading& reading,
               const SeenPose& now,
               const SeenPose* before,
               ReadingComparison* comparison) const override {
    comparison->difference = Predicted(now, before) - Measured(reading);
    comparison->by_now.leftCols<3>().setIdentity();
    if (before != nullptr) comparison->by_before.leftCols<3>() = -Eigen::Matrix3d::Identity();
    return true;
  }
  ReadingNumbers Numbers(const Reading& reading,
                         const SeenPose& now,
                         const SeenPose* before) const override {
    return {Measured(reading), Predicted(now, before)};
  }
  Eigen::Vector3d Point(const Reading& reading) const override { return Measured(reading); }

 private:
  static Eigen::Vector3d Predicted(const SeenPose& now, const SeenPose* before) {
    return before == nullptr ? now.p_WQ : Eigen::Vector3d(now.p_WQ - before->p_WQ);
  }
  Eigen::Vector3d Measured(const Reading& reading) const {
    if (reading.previous_idx < 0) return recording().p_WQ.row(reading.row_idx);
    if (HasDisplacements()) return recording().displacement.row(reading.row_idx);
    return recording().p_WQ.row(reading.row_idx) - recording().p_WQ.row(reading.previous_idx);
  }
  bool HasDisplacements() const { return recording().displacement.rows() > 0; }
};

class AdjacentPositionType final : public MeasurementType {
 public:
  MeasurementKind Describe() const override {
    MeasurementKind kind;
    kind.name = "adjacent_position";
    kind.sentence = "displacement of the tool point between successive poses";
    kind.noun = "displacement";
    kind.coordinates = {{"dx", Unit::kMetre}, {"dy", Unit::kMetre}, {"dz", Unit::kMetre}};
    kind.pairs = true;
    kind.sees_offset = false;
    kind.shared_noise = true;
    return kind;
  }
  std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                    const Recording& recording) const override {
    return std::make_unique<AdjacentPosition>(spec, recording);
  }
  void Simulate(const MeasurementSpec& spec,
                const std::vector<Eigen::Isometry3d>& X_WQ,
                const ReadingNoise& noise,
                Rng* rng,
                Recording* recording) const override {
    // A shared error belongs to the pose, an independent one to the displacement.
    if (spec.noise == NoiseKind::kSharedPose) {
      return SimulatePositions(X_WQ, noise.length, rng, recording);
    }
    const int num_targets = std::max<int>(static_cast<int>(recording->target_names.size()), 1);
    recording->displacement.setConstant(
        static_cast<Eigen::Index>(X_WQ.size()), 3, std::numeric_limits<double>::quiet_NaN());
    for (int k = num_targets; k < recording->num_rows(); ++k) {
      const auto now = static_cast<std::size_t>(k);
      const auto before = static_cast<std::size_t>(k - num_targets);
      recording->displacement.row(k) =
          X_WQ[now].translation() - X_WQ[before].translation() + NormalVector(noise.length, rng);
    }
  }
};

}  // namespace

const MeasurementType& AdjacentPositionMeasurement() {
  static const AdjacentPositionType type;
  return type;
}

}  // namespace dhcal
