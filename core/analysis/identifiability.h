// Which parameters do the readings determine? Answers the question that English et al. (2004)
// leave open, from the singular value decomposition at the solution.
//
// Columns are scaled by what manufacture leaves open (one sigma, "tolerance"), rows by the noise.
// A direction with singular value s is then known to 1/s tolerances. Directions with s <= 1 are
// undetermined: the readings know them no better than the drawing does.
#ifndef DHCAL_CORE_ANALYSIS_IDENTIFIABILITY_H_
#define DHCAL_CORE_ANALYSIS_IDENTIFIABILITY_H_

#include <vector>

#include <Eigen/Core>

#include "core/math/truncated_svd.h"
#include "core/model/parameter.h"
#include "core/model/result.h"
#include "core/solver/linearization.h"

namespace dhcal {

/// What one parameter's verdict rests on; lengths and angles in units of its tolerance.
struct Determination {
  double alone = kNotSet;   // 1-sigma if all other parameters were known: 1 / column norm
  double sigma = kNotSet;   // 1-sigma from the determined directions
  double hidden = kNotSet;  // share (root of sum of squares) that lies in undetermined directions
  Verdict verdict = Verdict::kFixed;
};

struct Identifiability {
  TruncatedSvd readings;       // noise rule, readings alone: decides the verdicts
  TruncatedSvd all;            // noise rule, with priors: decides the covariance
  Eigen::MatrixXd covariance;  // [rad^2, m^2], with the tolerance along what is dropped
  std::vector<Determination> parameters;
  ObservabilityIndices observability;
  double condition_number = kNotSet;  // of the directions kept
  int numerical_rank = -1;  // directions that the readings respond to at all, above rounding
};

/// `readings` and `all` are linearised at the solution; `num_poses` for the index O1.
Identifiability Identify(const Linearization& readings,
                         const Linearization& all,
                         const Eigen::VectorXd& tolerance,
                         int num_poses);

/// The rule behind a verdict, from a parameter's determination:
///   unobservable  even alone it is known no better than the tolerance (alone >= 1), or it lies in
///                 undetermined directions but for a thousandth
///   confounded    more than a seventh of the tolerance stays hidden among other parameters
///   identified    sigma below a third of the tolerance, and what is hidden below a fifth of sigma
///                 (so that the interval covers)
///   weak          everything between
Verdict VerdictOf(const Determination& determination);

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_IDENTIFIABILITY_H_
