// A standard table that is declared modified, or the reverse.
#include "problems/setup/cause.h"

namespace dhcal {
namespace {

class ConventionKind : public CauseKind {
 public:
  std::string name() const override { return "convention"; }
  bool spoils_all() const override { return true; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    if (files.spec.urdf) return;  // nobody declared it
    set_ups->push_back(from);
    set_ups->back().other_convention = !from.other_convention;
  }
  int Weight(const SetUp& set_up) const override { return set_up.other_convention ? kOneCause : 0; }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (!set_up.other_convention) return;
    set_ups->push_back(set_up);
    set_ups->back().other_convention = false;
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (!set_up.other_convention) return;
    const bool standard = files.robot().convention == DhConvention::kStandard;
    const std::string other = standard ? "modified" : "standard";
    SetupCause cause;
    cause.kind = name();
    cause.sentence = "the table is written in the " + other + " Denavit-Hartenberg convention";
    cause.where = files.robot().where;
    cause.text = "convention: " + other;
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    if (!set_up.other_convention) return;
    DhConvention& convention = files->spec.robot.convention;
    convention =
        convention == DhConvention::kStandard ? DhConvention::kModified : DhConvention::kStandard;
  }
};

}  // namespace

const CauseKind& Convention() {
  static const ConventionKind kind;
  return kind;
}

}  // namespace dhcal
