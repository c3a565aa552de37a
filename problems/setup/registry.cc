#include "problems/setup/cause.h"

namespace dhcal {

const std::vector<const CauseKind*>& CauseKinds() {
  // Cures are made in this order: units of the table before its zeros, the order of columns before
  // what is said of joints.
  static const std::vector<const CauseKind*> kinds = {&Convention(),
                                                      &TableUnit(),
                                                      &TableLength(),
                                                      &JointOrder(),
                                                      &JointUnit(),
                                                      &JointSense(),
                                                      &ZeroOffset(),
                                                      &TurnsWithAnother(),
                                                      &ReadingUnit(),
                                                      &ToolUnit(),
                                                      &MirroredFrame(),
                                                      &RowShift(),
                                                      &FramePerRun()};
  return kinds;
}

int WeightOf(const SetUp& set_up) {
  int weight = 0;
  for (const CauseKind* kind : CauseKinds()) weight += kind->Weight(set_up);
  return weight;
}

CuredFiles Cured(const Files& files, const SetUp& set_up) {
  CuredFiles cured{files.spec, files.recording};
  for (const CauseKind* kind : CauseKinds()) kind->Cure(set_up, &cured);
  return cured;
}

}  // namespace dhcal
