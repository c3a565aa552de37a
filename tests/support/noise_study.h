// Repeats kr15_noisy over many noise draws: what the statistics promise, measured.
#ifndef DHCAL_TESTS_SUPPORT_NOISE_STUDY_H_
#define DHCAL_TESTS_SUPPORT_NOISE_STUDY_H_

#include <optional>

#include "core/model/problem_spec.h"

namespace dhcal {

struct NoiseStudy {
  double coverage = 0;  // share of 95 % intervals of identified parameters that hold
  int num_intervals = 0;
  double median_prediction = 0;  // [m] median over draws of the 3-D RMS error at new poses
  double median_full_turns = 0;  // [m] the same at poses that the robot's stops do not allow
  int num_failed = 0;            // draws without a usable fit
};

/// Runs `draws` noise draws (seeds 1, 2, ...) of `spec`, a simulated problem; predictions at 2,000
/// random poses within the KR 15/2's joint ranges, and at 2,000 over a full turn of every joint.
/// The truth at those poses comes from the independent kinematics.
NoiseStudy RunNoiseStudy(ProblemSpec spec, int draws);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_NOISE_STUDY_H_
