// What one run of the program found: plain data in SI units, written by core/io and core/report.
// Every number starts as NaN and every count as -1: what was not computed can be seen, and is
// left out of result.json.
#ifndef DHCAL_CORE_MODEL_RESULT_H_
#define DHCAL_CORE_MODEL_RESULT_H_

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/diagnosis.h"
#include "core/model/parameter.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/setup.h"
#include "core/model/task.h"

namespace dhcal {

constexpr double kNotSet = std::numeric_limits<double>::quiet_NaN();

enum class Termination {
  kNotRun,
  kKappa,        // ||J drho - dx|| <= kappa
  kSmallChange,  // step and cost change below their tolerances
  kIterationLimit,
  kDiverged,
  kFailed,  // the solver could not evaluate or solve
};

/// "kappa", "small_change", "iteration_limit", "diverged", "failed", "not_run".
const char* ToString(Termination termination);

struct IterationRecord {
  int iteration = -1;           // from 1
  double cost = kNotSet;        // 1/2 sum of whitened squares after the step
  double kappa_norm = kNotSet;  // ||J drho - dx|| of the step, [m]
  int rank = -1;
  double step_norm = kNotSet;  // of the step, in units of the parameters' tolerances
};

/// How far the data determine a parameter.
enum class Verdict { kIdentified, kWeak, kConfounded, kUnobservable, kFixed };

/// "identified", "weak", "confounded", "unobservable", "fixed".
const char* ToString(Verdict verdict);

struct ParameterResult {
  std::string name;
  Unit unit = Unit::kRadian;
  std::string unit_text;  // of an effect's parameter
  double nominal = kNotSet;
  double correction = kNotSet;
  double value = kNotSet;
  double sigma = kNotSet;  // includes the tolerance along undetermined directions
  double ci95_low = kNotSet, ci95_high = kNotSet;  // of the value
  Verdict verdict = Verdict::kFixed;
  std::vector<std::string> confounded_with;
  std::string explanation;  // one sentence; empty when identified
};

/// A direction of the parameters that the readings do not determine.
struct NullDirection {
  struct Entry {
    std::string name;
    double weight = 0;  // largest = 1; parameters in SI units
  };
  std::vector<Entry> direction;
  std::string explanation;
};

/// Observability indices of Sun and Hollerbach (2008), on the directions kept, of the whitened,
/// tolerance-scaled Jacobian.
struct ObservabilityIndices {
  double o1 = kNotSet, o2 = kNotSet, o3 = kNotSet, o4 = kNotSet, o5 = kNotSet;
};

/// Whether the 95 % intervals of the parameters hold. They know of noise and tolerances; what the
/// model leaves out moves parameters by any number of sigmas.
enum class IntervalVerdict { kHold, kGeometryIncomplete, kModelMissesNoise };

/// "hold", "geometry_incomplete", "model_misses_noise".
const char* ToString(IntervalVerdict verdict);

struct FitResult {
  SolverMethod solver = SolverMethod::kSvdGaussNewton;
  Termination termination = Termination::kNotRun;
  std::string message = "The solver was not called.";  // a sentence with both sides of the test
  bool usable = false;                                 // parameters may be used
  bool converged = false;
  int iterations = -1;
  int rank = -1;            // directions kept in the last step
  int rank_numerical = -1;  // directions that the readings respond to at all, above rounding
  int columns = -1;
  double kappa_norm = kNotSet;  // [m]
  double cost = kNotSet;
  double chi2_reduced = kNotSet;  // only with a known sigma
  double chi2_p = kNotSet;        // that noise of that sigma leaves as much or more
  double seconds = kNotSet;
  double rms = kNotSet;                 // [m] per measured coordinate, fitted rows
  double rms_point = kNotSet;           // [m] 3-D, where positions are measured
  double max_point = kNotSet;           // [m]
  double rms_rotation = kNotSet;        // [rad] per component, kind pose
  std::vector<double> singular_values;  // of the last step's Jacobian, descending
  std::string singular_values_of;       // in words: which scaling
  double truncation_cut = kNotSet;      // singular values at or below were set to zero
  double condition_number = kNotSet;    // of the directions kept
  ObservabilityIndices observability;
  std::vector<IterationRecord> trace;
  std::vector<ParameterResult> parameters;  // estimated and fixed, empty when not usable
  std::vector<NullDirection> null_space;
  /// Of the estimated parameters in their order, SI; with the tolerance along directions that the
  /// readings do not determine. Empty = not computed.
  Eigen::MatrixXd covariance;
  // Covariance from ceres::Covariance (SuiteSparse QR) against the SVD's own.
  std::string covariance_check;            // a sentence
  double covariance_difference = kNotSet;  // largest relative difference of sigma compared
};

struct ComparedParameter {
  std::string name;
  Unit unit = Unit::kRadian;
  double svd_gauss_newton = kNotSet;  // correction
  double levenberg_marquardt = kNotSet;
  double difference = kNotSet;     // outside the null space
  double in_null_space = kNotSet;  // part of the difference that no reading can see
};

struct Baseline {
  double rms = kNotSet;        // [m]
  double rms_point = kNotSet;  // [m]
  double max_point = kNotSet;  // [m]
};

struct ValidationResult {
  std::string method;               // "set column" or "blocked k-fold"; empty = none
  int rows = -1;                    // rows predicted
  double rms_train = kNotSet;       // [m] per coordinate
  double rms_test = kNotSet;        // [m]
  double rms_point_test = kNotSet;  // [m]
  double max_point_test = kNotSet;  // [m]
  double noise_sigma = kNotSet;     // [m]
};

/// One reading of one row, for residuals.csv; coordinates in SI ([m], [rad] for rotations).
struct RowResidual {
  int row_idx = -1;
  bool test = false;
  Eigen::VectorXd measured, predicted_before, predicted_after;
  Eigen::VectorXd predicted_effects;       // by the delivered model, where there is one
  Eigen::VectorXd residual, standardised;  // of the last prediction
  double length = kNotSet;                 // [m] of the residual, its rotations apart
  double sigmas = kNotSet;                 // largest standardised coordinate, by size
  double leverage = kNotSet;  // sum over the row's coordinates; NaN for rows not fitted
  std::string run;            // the row's label; empty when the recording has none
  std::string set_aside;      // why; empty for rows that are used
};

/// A row that is neither fitted nor tested with.
struct RowSetAside {
  int row_idx = -1;
  bool test = false;
  std::string reason;     // what is odd about it, in words
  double size = kNotSet;  // [m] how far it lies off
};

/// How a joint errs at the rows, as the readings show it: for reports. Three vectors of one length,
/// [rad] of a revolute joint, [m] of a prismatic one, in DH's sense.
struct JointErrors {
  int joint_idx = -1;
  std::vector<double> q;         // as the controller reports it
  std::vector<double> error;     // what the effects found add to the joint, and what the row leaves
  std::vector<double> modelled;  // the former alone
};

/// What calibrated.yaml holds where physics or missing geometry was found: geometry and effects
/// fitted together.
struct DeliveredModel {
  RobotModel robot;
  std::vector<EffectRequest> effects;  // held at what was found, the problem file's first
  FitResult fit;
  ValidationResult validation;
  IntervalVerdict intervals = IntervalVerdict::kHold;
  /// The robot without the effects, for controllers that take Denavit-Hartenberg rows only; absent
  /// where no effects were found, or those of the instrument alone.
  std::optional<RobotModel> rigid;
  std::vector<JointErrors> joint_errors;  // of joints with effects, where points are measured
};

struct Result {
  std::string problem;
  std::string program_version;
  int rows = -1;  // fitted
  int rows_test = -1;
  int num_poses = -1;
  MeasurementKind kind;
  double noise_sigma = kNotSet;           // [m] used for the statistics
  double noise_sigma_rotation = kNotSet;  // [rad], kind pose
  std::string noise_source;               // "given", "estimated from the residuals", ...
  std::vector<FitResult> fits;
  int best_fit = -1;  // index into fits; -1 = none usable
  std::vector<ComparedParameter> comparison;
  Baseline nominal;  // rows predicted with the file's values
  std::optional<Baseline> base_and_tool_only;
  ValidationResult validation;
  IntervalVerdict intervals = IntervalVerdict::kHold;  // of the best fit's parameters
  /// The best fit leaves less than any instrument reads: the readings are a simulation without
  /// noise, and corrections are told in micrometres and microradians.
  bool noise_free = false;
  std::vector<std::string> coordinate_names;  // of RowResidual's vectors: "x", "y", "z", ...
  std::vector<RowResidual> residuals;
  RobotModel calibrated;  // the robot with the corrected values
  std::optional<DiagnosisResult> diagnosis;
  std::optional<DeliveredModel> delivered;
  std::optional<TaskError> task;  // of the model that is delivered
  std::vector<RowSetAside> rows_set_aside;
  bool simulated = false;
  SetupResult setup;
  std::vector<std::string> notes;  // warnings a reader of the report should see

  const FitResult* best() const { return best_fit < 0 ? nullptr : &fits[best_fit]; }
  /// The fit whose robot is delivered: with the effects found, else the best.
  const FitResult* delivered_fit() const { return delivered ? &delivered->fit : best(); }
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_RESULT_H_
