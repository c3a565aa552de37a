// A distance reading (ball bar, draw wire, interferometer).
//
//   h(X) = |p_WQ - p_WA|                  from the measured point Q to the anchor A [m]
//
// Not differentiable where Q meets the anchor; there the comparison says so and a step is rejected.
#include <algorithm>

#include <glog/logging.h>

#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

constexpr double kSmallestDistance = 1e-9;  // [m]

class Distance final : public Measurement {
 public:
  using Measurement::Measurement;

  std::string Missing() const override {
    const std::string distance = "distance_mm (or _m)";
    const bool has_anchor = !recording().anchor_idx.empty();
    if (recording().distance.rows() == 0 || !has_anchor) {
      return NeedsColumns(kind(), distance + " and anchor");
    }
    return recording().distance.array().isNaN().all()
               ? "the columns " + distance + " are blank in every row"
               : "";
  }
  bool HasReading(int row_idx) const override {
    return recording().distance.rows() > 0 && std::isfinite(recording().distance[row_idx]) &&
           recording().anchor_idx[static_cast<std::size_t>(row_idx)] >= 0;
  }
  bool Compare(const Reading& reading,
               const SeenPose& now,
               const SeenPose* /*before*/,
               ReadingComparison* comparison) const override {
    const Eigen::Vector3d p_AQ_W = now.p_WQ - p_WA(reading.row_idx);
    const double length = p_AQ_W.norm();
    if (length < kSmallestDistance) return false;
    comparison->difference[0] = length - recording().distance[reading.row_idx];
    comparison->by_now.leftCols<3>() = (p_AQ_W / length).transpose();
    return true;
  }
  ReadingNumbers Numbers(const Reading& reading,
                         const SeenPose& now,
                         const SeenPose* /*before*/) const override {
    return {recording().distance.segment(reading.row_idx, 1),
            Eigen::VectorXd::Constant(1, (now.p_WQ - p_WA(reading.row_idx)).norm())};
  }
  Eigen::Vector3d Point(const Reading& /*reading*/) const override {
    LOG(FATAL) << "a distance is no point";
  }

 private:
  Eigen::Vector3d p_WA(int row_idx) const {
    const auto name_idx =
        static_cast<std::size_t>(recording().anchor_idx[static_cast<std::size_t>(row_idx)]);
    const std::string& name = recording().anchor_names[name_idx];
    const auto found = std::find_if(spec().anchors.begin(),
                                    spec().anchors.end(),
                                    [&](const Anchor& anchor) { return anchor.name == name; });
    CHECK(found != spec().anchors.end()) << "anchor " << name << " was not checked on input";
    return found->p_WA;
  }
};

class DistanceType final : public MeasurementType {
 public:
  MeasurementKind Describe() const override {
    MeasurementKind kind;
    kind.name = "distance";
    kind.sentence = "distance of the tool point from an anchor";
    kind.noun = "distance";
    kind.coordinates = {{"distance", Unit::kMetre}};
    kind.anchors = true;
    return kind;
  }
  std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                    const Recording& recording) const override {
    return std::make_unique<Distance>(spec, recording);
  }
  void Simulate(const MeasurementSpec& spec,
                const std::vector<Eigen::Isometry3d>& X_WQ,
                const ReadingNoise& noise,
                Rng* rng,
                Recording* recording) const override {
    CHECK(!spec.anchors.empty());
    for (const Anchor& anchor : spec.anchors) recording->anchor_names.push_back(anchor.name);
    recording->distance.resize(static_cast<Eigen::Index>(X_WQ.size()));
    for (std::size_t k = 0; k < X_WQ.size(); ++k) {
      const std::size_t anchor = k % spec.anchors.size();
      recording->anchor_idx.push_back(static_cast<int>(anchor));
      recording->distance[static_cast<Eigen::Index>(k)] =
          (X_WQ[k].translation() - spec.anchors[anchor].p_WA).norm() + noise.length * rng->Normal();
    }
  }
};

}  // namespace

const MeasurementType& DistanceMeasurement() {
  static const DistanceType type;
  return type;
}

}  // namespace dhcal
