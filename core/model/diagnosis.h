// What a diagnosis found: plain data in SI units, written by problems/formats (FORMATS.md,
// section 3, key `diagnosis`) and core/report.
#ifndef DHCAL_CORE_MODEL_DIAGNOSIS_H_
#define DHCAL_CORE_MODEL_DIAGNOSIS_H_

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/effect_request.h"
#include "core/model/parameter.h"
#include "core/model/robot.h"

namespace dhcal {

enum class DiagnosisVerdict {
  kConsistent,
  kExplained,
  kPartlyExplained,
  kAmbiguous,
  kUnexplained,
  kFailed  // no answer: the diagnosis itself broke down
};

/// "consistent", "explained", "partly_explained", "ambiguous", "unexplained", "failed".
const char* ToString(DiagnosisVerdict verdict);

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Is there anything? Residuals of the complete geometry against the noise.
struct Misfit {
  double statistic = kUnknown;  // chi-square, or the largest score of all tests
  double dof = kUnknown;
  double p_value = kUnknown;      // family-wise, that nothing is left out
  double p_floor = kUnknown;      // the smallest that as many draws can give
  double noise_sigma = kUnknown;  // [m]
  bool noise_known = false;
  double rms = kUnknown;  // [m] per length as read, complete geometry
  int rows = -1;
  int outliers = -1;              // rows set aside, fitted or not
  std::vector<int> outlier_rows;  // which; count from 0
  /// Where the noise is not known: why the residuals have to say it.
  std::string why_estimated = "the noise is not given";
};

/// One cell of the mismatch map.
struct MapEntry {
  std::string slot;    // "theta3", "tool", "base"
  std::string driver;  // "q2", "time", "payload", a column's name
  double statistic = kUnknown;
  double dof = kUnknown;
  double p_value = kUnknown;  // of this cell alone
  double rms = kUnknown;      // [m] of readings that it would explain
};

struct HypothesisResult {
  std::vector<EffectRequest> effects;  // empty = geometry only
  double p_value = kUnknown;
  bool kept = false;
};

struct FoundParameter {
  std::string name;
  double value = kUnknown;
  double sigma = kUnknown;
  double ci95_low = kUnknown, ci95_high = kUnknown;
  std::string unit;
};

struct Confusable {
  EffectRequest effect;
  std::string location;
  double overlap = kUnknown;  // cosine of the two signatures beside the geometry
};

struct SeparatingPose {
  Eigen::VectorXd q;          // [rad] or [m]
  double payload = kUnknown;  // [kg] where it matters
};

struct Finding {
  EffectRequest effect;
  std::string effect_class, location, driver;
  std::vector<FoundParameter> parameters;
  std::string sentence;
  std::vector<std::string> cautions;  // sign, size, replication
  double p_value = kUnknown;
  double rms_train_before = kUnknown, rms_train_after = kUnknown;  // [m]
  double rms_test_before = kUnknown, rms_test_after = kUnknown;    // [m]
  double delta_bic = kUnknown;                                     // > 0 speaks for the effect
  double delta_log_predictive = kUnknown;
  double log_predictive_standard_error = kUnknown;
  std::vector<Confusable> confusable_with;
  std::string separating_advice;
  std::vector<SeparatingPose> separating_poses;
};

/// A geometric parameter that had swallowed part of the effects.
struct MovedParameter {
  std::string name;
  Unit unit = Unit::kRadian;
  double before = kUnknown, after = kUnknown;  // correction without and with the effects
  double sigma = kUnknown;                     // of it with the effects
};

struct CurvePoint {
  double driver_value = kUnknown;
  double amount = kUnknown;
  double sigma = kUnknown;
};

struct Unexplained {
  double fraction = kUnknown;  // of the misfit above the noise
  std::string slot, driver;    // empty where no place stands out
  std::string driver_unit;     // SI, of CurvePoint::driver_value; empty = not known
  Unit unit = Unit::kRadian;   // of CurvePoint::amount
  double rms = kUnknown;       // [m]
  std::vector<CurvePoint> curve;
};

/// What cannot be seen, and what it could do.
struct HiddenRisk {
  EffectRequest effect;
  double visibility = kUnknown;  // part of its movement that the geometry cannot absorb
  double limit = kUnknown;       // smallest first parameter found with 90 % probability, SI
  std::string unit;
  double risk = kUnknown;  // [m] largest error elsewhere that it may cause unseen (95 %)
};

struct NotTestable {
  std::string effect;
  std::string reason;
};

struct DiagnosisResult {
  DiagnosisVerdict verdict = DiagnosisVerdict::kConsistent;
  std::string summary;  // one sentence
  double false_alarm = kUnknown;
  Misfit misfit;
  std::vector<MapEntry> map;
  std::vector<HypothesisResult> hypotheses;
  std::vector<Finding> findings;  // geometry first
  /// All physics found, every line of a gear by itself, with the values of the fit: what a fit of
  /// other rows can hold.
  std::vector<EffectRequest> model;
  /// Corrections of the joint fit's geometry [rad or m] by the parameters' names, from where base
  /// and tool were aligned: where a fit of the same may start.
  std::map<std::string, double> geometry;
  /// Masses of the links as the joint fit has them, where those stated leave clearly more.
  std::vector<LinkMass> links;
  std::vector<MovedParameter> moved;
  std::optional<Unexplained> unexplained;
  std::vector<HiddenRisk> hidden;
  std::vector<NotTestable> not_testable;
  std::vector<std::string> notes;
  bool averaged = false;  // repeated readings were put together: RMS are those of their means
  std::string validation_method;
  double rms_train_before = kUnknown, rms_train_after = kUnknown;  // [m] complete geometry; + all
  double rms_test_before = kUnknown, rms_test_after = kUnknown;
  double seconds = kUnknown;

  /// False where the complete geometry had no fit, so that nothing could be measured.
  bool answered() const { return misfit.rows >= 0; }
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_DIAGNOSIS_H_
