// What is said of readings that were set aside although a joint moved them (rows/moved_by_joint.h).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MOVED_READINGS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MOVED_READINGS_H_

#include "core/model/diagnosis.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/rows/repeats.h"

namespace dhcal {

/// A note on each joint's readings, and, where nothing else is, the joint as what is unexplained.
void AddMovedReadings(const JointModel& model,
                      const LoopOutcome& outcome,
                      const DistinctRows& distinct,
                      DiagnosisResult* d);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_MOVED_READINGS_H_
