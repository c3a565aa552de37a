// A kind of measurement: what one reading is, and what a pose predicts for it.
//
//   difference = h(X_WQ) - y                    predicted minus measured; rotations as Log(R R_y')
//   d difference / d twist                      the pose's twist (d p_WQ, w) in W, 3 + 3
//
// Everything that needs to know what a reading is asks this class: residual blocks multiply the
// derivative by the twist of their parameters, the diagnosis by that of its slots, the simulator
// writes readings, checks and reports take the words. A new kind is one file beside this one and
// one line in registry.cc; no other file tells kinds apart.
#ifndef DHCAL_RESIDUALS_MEASUREMENT_H_
#define DHCAL_RESIDUALS_MEASUREMENT_H_

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "core/model/measurement_kind.h"
#include "core/model/problem_spec.h"
#include "core/model/reading.h"
#include "core/model/recording.h"

namespace dhcal {

/// The pose X_WQ of the tool's measured point as a reading sees it.
struct SeenPose {
  Eigen::Vector3d p_WQ = Eigen::Vector3d::Zero();      // [m]
  Eigen::Matrix3d R_WQ = Eigen::Matrix3d::Identity();  // read only where the kind sees orientation
};

/// The most coordinates that one reading may have.
constexpr int kMostCoordinates = 6;

/// Predicted minus measured, and how it changes with the twist (d p_WQ [m], turn w [rad], both in
/// W) of the reading's own pose and of the one before. Rows: the kind's coordinates.
struct ReadingComparison {
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostCoordinates, 1>;
  using TwistRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::ColMajor, kMostCoordinates, 6>;

  explicit ReadingComparison(int rows)
      : difference(Vector::Zero(rows)),
        by_now(TwistRows::Zero(rows, 6)),
        by_before(TwistRows::Zero(rows, 6)) {}

  Vector difference;
  TwistRows by_now;
  TwistRows by_before;
};

/// Numbers of a reading for people: positions [m], rotation vectors [rad], a distance [m].
struct ReadingNumbers {
  Eigen::VectorXd measured;
  Eigen::VectorXd predicted;
};

/// Standard deviations that a simulation puts on what it reads.
struct ReadingNoise {
  double length = 0;    // [m] per coordinate
  double rotation = 0;  // [rad] per component
};

/// Bound to the anchors of a problem file and to a recording, both of which must outlive it.
/// Immutable.
class Measurement {
 public:
  Measurement(const MeasurementSpec& spec, const Recording& recording)
      : spec_(spec), recording_(recording) {}
  virtual ~Measurement() = default;
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  const MeasurementKind& kind() const { return spec_.kind; }

  /// What the recording lacks, as a sentence that follows the file's name; empty = nothing.
  virtual std::string Missing() const = 0;
  /// True if the row's cells for this kind are not blank. Of a pair: the later row's.
  virtual bool HasReading(int row_idx) const = 0;
  /// Of a kind that reads pairs: a later row may be paired with this one.
  virtual bool CanPrecede(int row_idx) const { return HasReading(row_idx); }

  /// `before` is null where the reading has no predecessor. False where h is not differentiable.
  virtual bool Compare(const Reading& reading,
                       const SeenPose& now,
                       const SeenPose* before,
                       ReadingComparison* comparison) const = 0;
  /// The same reading in numbers.
  virtual ReadingNumbers Numbers(const Reading& reading,
                                 const SeenPose& now,
                                 const SeenPose* before) const = 0;
  /// The measured position, or displacement from the row before: closed-form starts align with
  /// it. Only where the kind is one of points.
  virtual Eigen::Vector3d Point(const Reading& reading) const = 0;
  /// R_WQ as measured; only where the kind sees orientation.
  virtual Eigen::Matrix3d Orientation(const Reading& reading) const;

 protected:
  const MeasurementSpec& spec() const { return spec_; }
  const Recording& recording() const { return recording_; }

 private:
  const MeasurementSpec& spec_;
  const Recording& recording_;
};

/// A kind as the registry holds it.
class MeasurementType {
 public:
  virtual ~MeasurementType() = default;

  virtual MeasurementKind Describe() const = 0;
  /// `spec` and `recording` must outlive the measurement.
  virtual std::unique_ptr<Measurement> Bind(const MeasurementSpec& spec,
                                            const Recording& recording) const = 0;
  /// Fills the columns of this kind in a recording whose joints and labels stand, as read from
  /// the poses `X_WQ` of its rows with noise.
  virtual void Simulate(const MeasurementSpec& spec,
                        const std::vector<Eigen::Isometry3d>& X_WQ,
                        const ReadingNoise& noise,
                        Rng* rng,
                        Recording* recording) const = 0;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_MEASUREMENT_H_
