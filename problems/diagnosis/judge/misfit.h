// How much the rows miss the geometry alone, beside what noise, and which of them were set aside.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MISFIT_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MISFIT_H_

#include <cstddef>

#include "core/model/diagnosis.h"
#include "core/model/recording.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/rows/repeats.h"

namespace dhcal {

/// Fills the misfit, but for its p. `before`: the geometry alone, of the `num_readings` that the
/// outcome was fitted to.
void DescribeMisfit(const JointRows& before,
                    std::size_t num_readings,
                    const LoopOutcome& outcome,
                    const DistinctRows& distinct,
                    DiagnosisResult* d);

/// Adds rows that other readings of their pose contradict to those that were set aside.
void AddMisreadRepeats(const Recording& recorded, const DistinctRows& distinct, Misfit* misfit);

/// How many times the stated noise is left, where no chance makes it so much larger; else 0.
double DoubtedNoise(const LoopOutcome& outcome);

/// What is said of the rows before anything is said of physics.
void AddNotesOnRows(const Loop& loop, const LoopOutcome& outcome, DiagnosisResult* d);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MISFIT_H_
