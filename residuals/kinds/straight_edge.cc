// The paper's measuring head over straight edges: a camera that reads a ruled edge and two lasers
// that read their distances from a flat edge parallel to it.
//
// W is the frame E of the reading's edge: x along the rulings, z out of the flat face. A sensor at
// S looks along the unit vector u (both fixed in the tool frame) and meets a plane z = c where
//   t(X) = (c - p_ES.z) / u.z                  length of its sight [m]
//   ruler = (p_ES + t u).x                     camera; c: the ruled face
//   height = t                                 lasers; c = 0: the flat face
// A reading is the difference from the row before of its run and edge: where the ruler begins, and
// what the lasers call zero, are not known. A pose's error enters both of its differences, which
// `noise: shared_pose` whitens exactly (residuals/series.h).
//
// Not differentiable where a sensor looks along the faces. English et al. (2004), "Measurement
// concept"; what the readings can show: straight_edge.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glog/logging.h>

#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

constexpr char kHeadColumns[] = "ruler_mm, height1_mm, height2_mm (or _m)";
// A sensor that looks along the faces to this sine sees nothing.
constexpr double kGrazing = 1e-3;

using HeadTwistRows = Eigen::Matrix<double, 3, 6>;
using RowVector6 = Eigen::Matrix<double, 1, 6>;

/// What a sensor sees of a plane z = c.
struct Sight {
  Eigen::Vector3d u;     // along the sight, in E
  double length = 0;     // [m]
  Eigen::Vector3d at;    // where it meets the plane
  RowVector6 length_by;  // d length / d twist of Q
  RowVector6 ruler_by;   // d at.x / d twist of Q
};

/// Nothing where the sensor looks along the plane.
std::optional<Sight> Look(const HeadSensor& sensor, const SeenPose& pose, double plane) {
  const Eigen::Vector3d p_QS_E = pose.R_WQ * sensor.p_QS;
  Sight sight;
  sight.u = pose.R_WQ * sensor.axis;
  if (std::abs(sight.u.z()) < kGrazing) return std::nullopt;
  sight.length = (plane - pose.p_WQ.z() - p_QS_E.z()) / sight.u.z();
  const Eigen::Vector3d p_QM_E = p_QS_E + sight.length * sight.u;
  sight.at = pose.p_WQ + p_QM_E;
  // The twist moves the point of the sight that is at M by t + w x p_QM; M stays in the plane.
  RowVector6 x_by, z_by;
  x_by << 1, 0, 0, 0, p_QM_E.z(), -p_QM_E.y();
  z_by << 0, 0, 1, p_QM_E.y(), -p_QM_E.x(), 0;
  sight.length_by = -z_by / sight.u.z();
  sight.ruler_by = x_by + sight.u.x() * sight.length_by;
  return sight;
}

/// The three numbers that a head reads at a pose, and their derivatives by its twist.
struct HeadReading {
  Eigen::Vector3d numbers;  // ruler, height1, height2 [m]
  HeadTwistRows by_twist;
};

std::optional<HeadReading> ReadHead(const HeadSpec& head, const SeenPose& pose) {
  HeadReading reading;
  const std::optional<Sight> camera = Look(head.camera, pose, head.ruler_height);
  if (!camera) return std::nullopt;
  reading.numbers[0] = camera->at.x();
  reading.by_twist.row(0) = camera->ruler_by;
  for (std::size_t k = 0; k < head.lasers.size(); ++k) {
    const std::optional<Sight> laser = Look(head.lasers[k], pose, 0);
    if (!laser) return std::nullopt;
    const auto row = static_cast<Eigen::Index>(k) + 1;
    reading.numbers[row] = laser->length;
    reading.by_twist.row(row) = laser->length_by;
  }
  return reading;
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
