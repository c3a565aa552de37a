// A joint that the controller counts against the horizon or against another joint: its angle in the
// table is its own coordinate and that of another one together.
#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr int kMostApart = 2;  // joints between which such couplings are usual

class CouplingKind : public CauseKind {
 public:
  std::string name() const override { return "coupling"; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    for (int j = 1; j < files.num_joints(); ++j) {
      for (int driver = std::max(j - kMostApart, 0); driver < j; ++driver) {
        if (!files.revolute(j) || !files.revolute(driver)) continue;
        for (const int factor : {1, -1}) {
          set_ups->push_back(from);
          SetUp::Joint& joint = set_ups->back().joints[static_cast<std::size_t>(j)];
          joint.driver = driver;
          joint.driver_factor = factor;
        }
      }
    }
  }
  int Weight(const SetUp& set_up) const override {
    int count = 0;
    for (const SetUp::Joint& joint : set_up.joints) count += joint.driver >= 0 ? 1 : 0;
    return kOneCause * count;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (set_up.joints[j].driver < 0) continue;
      set_ups->push_back(set_up);
      set_ups->back().joints[j].driver = -1;
      set_ups->back().joints[j].driver_factor = 0;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    for (int j = 0; j < files.num_joints(); ++j) {
      const SetUp::Joint& joint = set_up.joints[static_cast<std::size_t>(j)];
      if (joint.driver < 0) continue;
      const double sign = files.robot().joints[static_cast<std::size_t>(j)].sign * joint.sense;
      SetupCause cause;
      cause.kind = name();
      cause.joints = {j + 1, joint.driver + 1};
      cause.sentence = fmt::format("the angle of {} in the table is {}q{} {} q{}",
                                   JointList(files, {j}),
                                   sign < 0 ? "-" : "",
                                   j + 1,
                                   joint.driver_factor > 0 ? "+" : "-",
                                   joint.driver + 1);
      cause.where = files.spec.parameters.where;
      cause.text = fmt::format(
          "effects: [{{effect: joint_coupling, joint: {}, driver_joint: {}, values: {{coupling: "
          "{}}}}}]",
          j + 1,
          joint.driver + 1,
          joint.driver_factor);
      causes->push_back(cause);
    }
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      const SetUp::Joint& joint = set_up.joints[j];
      if (joint.driver < 0) continue;
      EffectRequest request;
      request.effect = "joint_coupling";
      request.joint = static_cast<int>(j) + 1;
      request.settings["driver_joint"] = joint.driver + 1;
      request.values["coupling"] = joint.driver_factor;
      request.held = true;
      request.where = files->spec.parameters.where;
      files->spec.parameters.effects.push_back(request);
    }
  }
};

}  // namespace

const CauseKind& TurnsWithAnother() {
  static const CouplingKind kind;
  return kind;
}

}  // namespace dhcal
