// The paper's measuring head over straight edges: a camera that reads a ruled edge and two lasers
// that read their distances from a flat edge parallel to it.
//
// W is the frame E of the reading's edge; what the sensors see of it: core/kinematics/head_sight.h.
// A reading is the difference from the row before of its run and edge: where the ruler begins, and
// what the lasers call zero, are not known. A pose's error enters both of its differences, which
// `noise: shared_pose` whitens exactly (residuals/series.h).
//
// Not differentiable where a sensor looks along the faces. English et al. (2004), "Measurement
// concept"; what the readings can show: straight_edge.md.
#include <limits>
#include <optional>

#include <glog/logging.h>

#include "core/kinematics/head_sight.h"
#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

constexpr char kHeadColumns[] = "ruler_mm, height1_mm, height2_mm (or _m)";
using HeadTwistRows = HeadSights::TwistRows;

/// The three numbers that a head reads at a pose, and their derivatives by its twist.
struct HeadReading {
  Eigen::Vector3d numbers;  // ruler, height1, height2 [m]
  HeadTwistRows by_twist;
};

std::optional<HeadReading> ReadHead(const HeadSpec& head, const SeenPose& pose) {
  const std::optional<HeadSights> sights = SightsOf(head, pose.p_WQ, pose.R_WQ);
  if (!sights) return std::nullopt;
  return HeadReading{sights->numbers(), sights->by_twist()};
}

class StraightEdge final : public Measurement {
 public:
  using Measurement::Measurement;

  std::string Missing() const override {
    if (recording().head.rows() == 0 || recording().edge_idx.empty()) {
      return NeedsColumns(kind(), std::string(kHeadColumns) + " and edge");
    }
    return MissingColumns(kind(), {{kHeadColumns, recording().head}});
  }
  bool HasReading(int row_idx) const override {
    return Present(recording().head, row_idx) && recording().edge(row_idx) >= 0;
  }
  bool Compare(const Reading& reading,
               const SeenPose& now,
               const SeenPose* before,
               ReadingComparison* comparison) const override {
    const std::optional<HeadReading> here = ReadHead(spec().head, now);
    if (!here) return false;
    comparison->difference = here->numbers - Measured(reading);
    comparison->by_now = here->by_twist;
    if (before == nullptr) return true;
    const std::optional<HeadReading> there = ReadHead(spec().head, *before);
    if (!there) return false;
    comparison->difference -= there->numbers;
    comparison->by_before = -there->by_twist;
    return true;
  }
  ReadingNumbers Numbers(const Reading& reading,
                         const SeenPose& now,
                         const SeenPose* before) const override {
    Eigen::Vector3d predicted = Seen(now);
    if (before != nullptr) predicted -= Seen(*before);
    return {Measured(reading), predicted};
  }
  Eigen::Vector3d Point(const Reading& /*reading*/) const override {
    LOG(FATAL) << "a head over an edge reads no point";
  }

 private:
  Eigen::Vector3d Seen(const SeenPose& pose) const {
    const std::optional<HeadReading> reading = ReadHead(spec().head, pose);
    return reading ? reading->numbers
                   : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::Vector3d Measured(const Reading& reading) const {
    Eigen::Vector3d now = recording().head.row(reading.row_idx);
    if (reading.previous_idx < 0) return now;
    return now - Eigen::Vector3d(recording().head.row(reading.previous_idx));
  }
};

class StraightEdgeType final : public MeasurementType {
 public:
  MeasurementKind Describe() const override {
    MeasurementKind kind;
    kind.name = "straight_edge";
    kind.sentence = "change of a ruler reading and of two laser heights between adjacent poses";
    kind.noun = "reading";
    kind.coordinates = {
        {"ruler", Unit::kMetre}, {"height1", Unit::kMetre}, {"height2", Unit::kMetre}};
    kind.pairs = true;
    kind.edges = true;
    kind.several_points = true;
    kind.shared_noise = true;
    kind.hidden = {{0, "is along the ruler: its readings are differences, whose sum has no start"},
                   {1, "is across the edge, which looks the same all along"}};
    return kind;
  }
  std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                    const Recording& recording) const override {
    return std::make_unique<StraightEdge>(spec, recording);
  }
  void Simulate(const MeasurementSpec& spec,
                const std::vector<Eigen::Isometry3d>& X_WQ,
                const ReadingNoise& noise,
                Rng* rng,
                Recording* recording) const override {
    const auto rows = static_cast<Eigen::Index>(X_WQ.size());
    if (recording->edge_idx.empty()) {
      recording->edge_names = {"1"};
      recording->edge_idx.assign(X_WQ.size(), 0);
    }
    recording->head.setConstant(rows, 3, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < rows; ++k) {
      // Drawn for every row, so that those of others do not depend on what a row shows.
      const Eigen::Vector3d error = NormalVector(noise.length, rng);
      const Eigen::Isometry3d& X = X_WQ[static_cast<std::size_t>(k)];
      const std::optional<HeadReading> reading = ReadHead(spec.head, {X.translation(), X.linear()});
      if (!reading || recording->edge(static_cast<int>(k)) < 0) continue;
      for (int c = 0; c < 3; ++c) {
        recording->head(k, c) = reading->numbers[c] +
                                spec.kind.coordinates[static_cast<std::size_t>(c)].noise * error[c];
      }
    }
  }
};

}  // namespace

const MeasurementType& StraightEdgeMeasurement() {
  static const StraightEdgeType type;
  return type;
}

}  // namespace dhcal
