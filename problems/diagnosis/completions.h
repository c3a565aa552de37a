// Geometric freedoms that a problem file may leave out: a tilt of parallel axes, the base frame,
// the tool frame (PHYSICS.md X1).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_COMPLETIONS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_COMPLETIONS_H_

#include <string>
#include <vector>

#include "core/model/diagnosis.h"
#include "core/model/parameter.h"
#include "problems/calibration.h"
#include "problems/fit.h"

namespace dhcal {

/// A completion: the effect that names it and the parameters that it frees.
struct Completion {
  EffectRequest request;
  std::vector<Parameter> parameters;
};

/// What `complete` estimates and `user` does not, one completion per frame or axis.
std::vector<Completion> MissingCompletions(const Calibration& user, const Calibration& complete);

/// The problem with the parameters of a completion estimated besides its own.
ProblemSpec WithCompletion(const ProblemSpec& spec, const Completion& completion);

/// The finding, with its size from a fit that estimates the completion's parameters. The sentence
/// names those that are known to a third of their tolerance.
Finding DescribeCompletion(const Completion& completion,
                           const Calibration& calibration,
                           const Fit& fit,
                           double p_value);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_COMPLETIONS_H_
