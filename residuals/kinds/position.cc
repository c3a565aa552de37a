// An absolute position reading.
//
//   h(X) = p_WQ                           position of the measured point Q in W [m]
//
// Differentiable everywhere. English et al. (2004), eq. (11) with the sign of a residual.
#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

class Position final : public Measurement {
 public:
  using Measurement::Measurement;

  std::string Missing() const override {
    return MissingColumns(kind(), {{kPositionColumns, recording().p_WQ}});
  }
  bool HasReading(int row_idx) const override { return Present(recording().p_WQ, row_idx); }
  bool Compare(const Reading& reading,
               const SeenPose& now,
               const SeenPose* /*before*/,
               ReadingComparison* comparison) const override {
    comparison->difference = now.p_WQ - Point(reading);
    comparison->by_now.leftCols<3>().setIdentity();
    return true;
  }
  ReadingNumbers Numbers(const Reading& reading,
                         const SeenPose& now,
                         const SeenPose* /*before*/) const override {
    return {Point(reading), now.p_WQ};
  }
  Eigen::Vector3d Point(const Reading& reading) const override {
    return recording().p_WQ.row(reading.row_idx);
  }
};

class PositionType final : public MeasurementType {
 public:
  MeasurementKind Describe() const override {
    MeasurementKind kind;
    kind.name = "position";
    kind.sentence = "position of the tool point";
    kind.noun = "position";
    kind.coordinates = PointCoordinates();
    return kind;
  }
  std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                    const Recording& recording) const override {
    return std::make_unique<Position>(spec, recording);
  }
  void Simulate(const MeasurementSpec& /*spec*/,
                const std::vector<Eigen::Isometry3d>& X_WQ,
                const ReadingNoise& noise,
                Rng* rng,
                Recording* recording) const override {
    SimulatePositions(X_WQ, noise.length, rng, recording);
  }
};

}  // namespace

const MeasurementType& PositionMeasurement() {
  static const PositionType type;
  return type;
}

}  // namespace dhcal
