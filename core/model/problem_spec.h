// What a problem file says (FORMATS.md, section 2), after parsing: plain data in SI units.
#ifndef DHCAL_CORE_MODEL_PROBLEM_SPEC_H_
#define DHCAL_CORE_MODEL_PROBLEM_SPEC_H_

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/effect_request.h"
#include "core/model/head.h"
#include "core/model/joint_numbers.h"
#include "core/model/measurement_kind.h"
#include "core/model/recording.h"
#include "core/model/robot.h"
#include "core/model/task.h"

namespace dhcal {

enum class NoiseKind { kIndependent, kSharedPose };
enum class SolverMethod { kSvdGaussNewton, kLevenbergMarquardt, kBoth };
enum class TruncationRule { kNoise, kPaper, kRelative };
enum class LossKind { kNone, kHuber, kCauchy, kTukey };

const char* ToString(SolverMethod method);

struct MeasurementSpec {
  MeasurementKind kind;                  // of the registry, residuals/registry.h
  std::optional<double> sigma;           // [m] one measured coordinate; absent = estimated
  std::optional<double> sigma_rotation;  // [rad] one component; absent = estimated
  NoiseKind noise = NoiseKind::kIndependent;
  bool anchored = false;        // pairs: the first pose of each run and target is read, too
  std::vector<Anchor> anchors;  // where the kind has anchors
  HeadSpec head;                // where the kind reads edges
  std::vector<Edge> edges;      // those that the file names
  SourceLocation where;
};

struct ParameterSpec {
  // Group names, parameter names or "complete", as written; resolved against the robot later.
  std::vector<std::string> estimate = {"theta", "alpha", "a", "d"};
  std::vector<std::string> fix;
  std::map<std::string, double> prior_sigma;  // group or name without unit suffix -> SI
  std::vector<EffectRequest> effects;         // physics to estimate along with the geometry
  SourceLocation where;
};

struct SolverSpec {
  SolverMethod method = SolverMethod::kSvdGaussNewton;
  double kappa = 1e-8;  // [m]
  TruncationRule rule = TruncationRule::kNoise;
  double relative_tolerance = 0;  // with kRelative
  int max_iterations = 50;
  LossKind loss = LossKind::kNone;
  double loss_scale = 1.0;  // [sigmas]
};

enum class MotionKind { kIncrements, kRandom, kLine, kFile };

/// A straight path of the tool point, the tool turned as at its start.
struct MotionLine {
  Eigen::Isometry3d X_WQ = Eigen::Isometry3d::Identity();  // at the start
  Eigen::Vector3d p_WQ_end = Eigen::Vector3d::Zero();      // [m]
};

/// A line over every edge, from -length / 2 to length / 2 along it, the tool's z axis into the
/// face.
struct AlongEdges {
  double length = 0;     // [m]
  double stand_off = 0;  // [m] of the tool point
};

struct MotionSpec {
  MotionKind kind = MotionKind::kRandom;
  int num_poses = 100;         // of each line, kLine
  Eigen::VectorXd home;        // [rad] or [m], kIncrements; near the lines' starts, kLine
  Eigen::VectorXd increments;  // per step, kIncrements
  Eigen::VectorXd lower;       // kRandom: uniform in [lower, upper]
  Eigen::VectorXd upper;
  std::vector<MotionLine> lines;          // kLine, or:
  std::optional<AlongEdges> along_edges;  // kLine
  double tilt = 0;   // [rad] kLine: of the tool, its rotation vector's components in +- tilt
  std::string file;  // kFile: a recording's joint columns; resolved path
};

/// A recording made from the nominal robot plus known errors.
struct SimulationSpec {
  MotionSpec motion;
  /// Errors added to the nominal rows, per number of a row (JointSlot): length n, or empty.
  std::array<Eigen::VectorXd, kNumJointNumbers> rows;
  Eigen::VectorXd& row_errors(JointSlot slot) { return rows[static_cast<std::size_t>(slot)]; }
  const Eigen::VectorXd& row_errors(JointSlot slot) const {
    return rows[static_cast<std::size_t>(slot)];
  }
  Eigen::VectorXd base, tool;          // 6 or empty: x y z [m], rx ry rz [rad]
  std::vector<EffectRequest> effects;  // with values
  double noise = 0;                    // [m]
  double noise_rotation = 0;           // [rad] for kind pose
  std::uint64_t seed = 1;
};

enum class DiagnosisRun { kAuto, kAlways, kNever };

struct DiagnosisSpec {
  DiagnosisRun run = DiagnosisRun::kAuto;
  std::vector<std::string> effects;  // names; empty = all of the library
  double false_alarm = 0.01;         // family-wise
};

/// The robot description (URDF) that the robot's rows were made from.
struct UrdfSource {
  std::string file;  // resolved path
  std::string text;  // its content when it was read
  std::string base_link, tip_link;
};

struct ProblemSpec {
  std::string file;  // path as given
  std::string name;
  RobotModel robot;
  std::optional<UrdfSource> urdf;  // absent: the file has the rows themselves
  MeasurementSpec measurement;
  std::string recording;  // resolved path; empty when simulated
  SourceLocation recording_where;
  std::vector<ColumnAlias> columns;  // of the recording
  ParameterSpec parameters;
  SolverSpec solver;
  DiagnosisSpec diagnosis;
  std::optional<TaskSpec> task;
  std::optional<SimulationSpec> simulate;
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_PROBLEM_SPEC_H_
