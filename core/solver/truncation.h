// The three named rules that decide which singular values count as zero.
#ifndef DHCAL_CORE_SOLVER_TRUNCATION_H_
#define DHCAL_CORE_SOLVER_TRUNCATION_H_

#include <string>

#include "core/math/truncated_svd.h"
#include "core/model/problem_spec.h"
#include "core/solver/linearization.h"

namespace dhcal {

/// kPaper:    s_i / s_max <= columns * epsilon, on the Jacobian as it stands, metres beside
///            radians (English et al. 2004, after Numerical Recipes).
/// kNoise:    columns in units of their tolerance, rows in units of their noise: keep a direction
///            only if the readings determine it better than manufacture does, s_i > 1.
/// kRelative: s_i / s_max <= the number given, in tolerance-scaled columns.
struct Truncation {
  TruncationRule rule = TruncationRule::kNoise;
  double relative = 0;  // with kRelative
};

/// Decomposes the linearisation and sets the cut.
TruncatedSvd Truncate(const Truncation& truncation,
                      const Eigen::VectorXd& tolerance,
                      const Linearization& linearization);

/// One line: what was decomposed and where the cut lies.
std::string Describe(const Truncation& truncation);

}  // namespace dhcal

#endif  // DHCAL_CORE_SOLVER_TRUNCATION_H_
