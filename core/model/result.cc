#include "core/model/result.h"

namespace dhcal {

const char* ToString(Termination termination) {
  switch (termination) {
    case Termination::kNotRun:
      return "not_run";
    case Termination::kKappa:
      return "kappa";
    case Termination::kSmallChange:
      return "small_change";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kDiverged:
      return "diverged";
    case Termination::kFailed:
      return "failed";
  }
  return "?";
}

const char* ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentified:
      return "identified";
    case Verdict::kWeak:
      return "weak";
    case Verdict::kConfounded:
      return "confounded";
    case Verdict::kUnobservable:
      return "unobservable";
    case Verdict::kFixed:
      return "fixed";
  }
  return "?";
}

const char* ToString(IntervalVerdict verdict) {
  switch (verdict) {
    case IntervalVerdict::kHold:
      return "hold";
    case IntervalVerdict::kGeometryIncomplete:
      return "geometry_incomplete";
    case IntervalVerdict::kModelMissesNoise:
      return "model_misses_noise";
  }
  return "?";
}

const char* ToString(SolverMethod method) {
  switch (method) {
    case SolverMethod::kSvdGaussNewton:
      return "svd_gauss_newton";
    case SolverMethod::kLevenbergMarquardt:
      return "levenberg_marquardt";
    case SolverMethod::kBoth:
      return "both";
  }
  return "?";
}

}  // namespace dhcal
