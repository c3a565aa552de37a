// From the loop's outcome to a result: findings, alternatives, rest, verdict.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CONCLUDE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CONCLUDE_H_

#include "core/model/diagnosis.h"
#include "problems/diagnosis/loop.h"

namespace dhcal {

/// What the verdict is made of.
struct Judged {
  bool rest = false;    // what is left has a pattern
  bool cells = false;   // part of the model has no name
  bool moved = false;   // a joint moved readings that were set aside
  double restless = 0;  // times the stated noise, what is left; 0 = it is not clearly larger
  double doubted = 0;   // the same, of a noise that no chance makes so much larger; 0 = it may

  bool pattern() const { return rest || cells || moved; }
};

/// Fills verdict and summary from the findings, what they may be confused with, and the rest.
void GiveVerdict(const Judged& judged, DiagnosisResult* d);

/// Lists what the listed sets have in the place of each finding.
void AddConfusables(const JointModel& model, const LoopOutcome& outcome, DiagnosisResult* d);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_CONCLUDE_H_
