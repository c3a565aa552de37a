// What a diagnosis starts from: its rows' noise, the geometry that the file leaves open, and the
// frames that it conceals.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_LOOP_INPUTS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_LOOP_INPUTS_H_

#include <vector>

#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/model/result.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/refit/joint_model.h"
#include "problems/progress.h"

namespace dhcal {

/// Of the false-alarm rate; the rest is for structures without a name.
constexpr double kShareOfNames = 0.5;

/// Frames that the file's own parameters imitate: findings, moved parameters and notes alone.
/// `model`: of the rows, with every geometric freedom. `identified`: the file's own fit, or none.
DiagnosisResult ConcealedFramesIn(const ProblemSpec& spec,
                                  const JointModel& model,
                                  const Result& identified,
                                  const Progress& progress);

/// The problem with the effects that a fit found held at their values, its masses stated.
ProblemSpec WithEffectsHeld(ProblemSpec spec, const JointRows& fit);

/// `averaged`: repeats were put together. `frames`: findings that belong to the geometry.
LoopInputs InputsOf(const ProblemSpec& spec,
                    const JointModel& model,
                    bool averaged,
                    const std::vector<Finding>& frames);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_LOOP_INPUTS_H_
