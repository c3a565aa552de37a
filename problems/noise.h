// The noise of the readings: given, or found from what the fit leaves.
#ifndef DHCAL_PROBLEMS_NOISE_H_
#define DHCAL_PROBLEMS_NOISE_H_

#include <string>

#include <Eigen/Core>

#include "core/solver/solver.h"
#include "problems/assembly.h"
#include "problems/calibration.h"

namespace dhcal {

/// Which of the sigmas the problem or the recording give.
struct NoiseSource {
  bool per_row = false;  // every row that is used has one of its own
  bool sigma_given = false;
  bool rotation_given = false;  // true where no rotation is measured
  std::string description;

  bool all_given() const { return sigma_given && rotation_given; }
};

NoiseSource SourceOfNoise(const Calibration& calibration);

/// No instrument on a robot reads finer; a simulation without noise is judged as if it had this.
constexpr double kFinestSigma = 1e-7;          // [m]
constexpr double kFinestSigmaRotation = 1e-7;  // [rad]

/// Given sigmas, and for the others what the linear model at the start leaves.
Noise InitialNoise(const Calibration& calibration);

/// `noise`, which whitens `problem`, with the sigmas that are not given replaced by what the
/// residuals at its state show, for `rank` parameters determined. With a robust loss by their
/// median absolute value.
Noise NoiseFromResiduals(const Calibration& calibration,
                         const CalibrationProblem& problem,
                         const Noise& noise,
                         int rank);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_NOISE_H_
