// Checks what a problem asks of physical effects against the recording that it is to be fitted to.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECT_CHECKS_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECT_CHECKS_H_

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"

namespace dhcal {

/// Errors for effects of `parameters` that the recording cannot show, that are held at values of
/// parameters they do not have, or that are one effect asked for twice.
void CheckEffectsFit(const ProblemSpec& spec, const Recording& recording, Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_EFFECT_CHECKS_H_
