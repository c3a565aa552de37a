// A position and orientation reading (6-D).
//
//   difference, rows 0-2: p_WQ - p_WQ_measured            [m]
//   difference, rows 3-5: Log(R_WQ R_WQ_measured'), in W  [rad]
//
// The rotation error is a 3-vector, smooth at zero (a scalar angle has no derivative there). Not
// differentiable where it reaches pi. d Log(Exp(w) R) = J_l^-1(Log R) w: Sola et al. (2018), eq.
// 144.
#include "core/math/rotation.h"
#include "residuals/kinds/columns.h"
#include "residuals/measurement.h"

namespace dhcal {
namespace {

constexpr char kQuaternionColumns[] = "qw, qx, qy, qz";

class Pose final : public Measurement {
 public:
  using Measurement::Measurement;

  std::string Missing() const override {
    return MissingColumns(
        kind(),
        {{kPositionColumns, recording().p_WQ}, {kQuaternionColumns, recording().quaternion}});
  }
  bool HasReading(int row_idx) const override {
    return Present(recording().p_WQ, row_idx) && Present(recording().quaternion, row_idx);
  }
  bool Compare(const Reading& reading,
               const SeenPose& now,
               const SeenPose* /*before*/,
               ReadingComparison* comparison) const override {
    const Eigen::Vector3d turn = LogSO3(now.R_WQ * Orientation(reading).transpose());
    comparison->difference << now.p_WQ - Point(reading), turn;
    comparison->by_now.setZero();
    comparison->by_now.topLeftCorner<3, 3>().setIdentity();
    comparison->by_now.bottomRightCorner<3, 3>() = LeftJacobianInverseSO3(turn);
    return true;
  }
  ReadingNumbers Numbers(const Reading& reading,
                         const SeenPose& now,
                         const SeenPose* /*before*/) const override {
    ReadingNumbers numbers{Eigen::VectorXd(6), Eigen::VectorXd(6)};
    numbers.measured << Point(reading), LogSO3(Orientation(reading));
    numbers.predicted << now.p_WQ, LogSO3(now.R_WQ);
    return numbers;
  }
  Eigen::Vector3d Point(const Reading& reading) const override {
    return recording().p_WQ.row(reading.row_idx);
  }
  Eigen::Matrix3d Orientation(const Reading& reading) const override {
    const Eigen::Vector4d q = recording().quaternion.row(reading.row_idx);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  }
};

class PoseType final : public MeasurementType {
 public:
  MeasurementKind Describe() const override {
    MeasurementKind kind;
    kind.name = "pose";
    kind.sentence = "position and orientation of the tool";
    kind.noun = "position";
    kind.coordinates = PointCoordinates();
    for (const char* const name : {"rx", "ry", "rz"}) {
      kind.coordinates.push_back({name, Unit::kRadian});
    }
    return kind;
  }
  std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                    const Recording& recording) const override {
    return std::make_unique<Pose>(spec, recording);
  }
  void Simulate(const MeasurementSpec& /*spec*/,
                const std::vector<Eigen::Isometry3d>& X_WQ,
                const ReadingNoise& noise,
                Rng* rng,
                Recording* recording) const override {
    SimulatePositions(X_WQ, noise.length, rng, recording);
    recording->quaternion.resize(static_cast<Eigen::Index>(X_WQ.size()), 4);
    for (std::size_t k = 0; k < X_WQ.size(); ++k) {
      const Eigen::Vector3d turn = NormalVector(noise.rotation, rng);
      const Eigen::Quaterniond q(ExpSO3<double>(turn) * X_WQ[k].linear());
      recording->quaternion.row(static_cast<Eigen::Index>(k)) << q.w(), q.x(), q.y(), q.z();
    }
  }
};

}  // namespace

const MeasurementType& PoseMeasurement() {
  static const PoseType type;
  return type;
}

}  // namespace dhcal
