// Joints that the controller counts the other way.
#include <algorithm>

#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

class JointSenseKind : public CauseKind {
 public:
  std::string name() const override { return "joint_sense"; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < static_cast<std::size_t>(files.num_joints()); ++j) {
      set_ups->push_back(from);
      set_ups->back().joints[j].sense *= -1;
    }
  }
  void FarJumps(const Files& files, const SetUp& from, std::vector<SetUp>* set_ups) const override {
    constexpr int kMostPatterned = 7;  // joints; 128 patterns
    const int n = std::min(files.num_joints(), kMostPatterned);
    for (int pattern = 1; pattern < (1 << n); ++pattern) {
      set_ups->push_back(from);
      for (int j = 0; j < n; ++j) {
        if ((pattern >> j) % 2 == 1) set_ups->back().joints[static_cast<std::size_t>(j)].sense = -1;
      }
    }
  }
  int Weight(const SetUp& set_up) const override {
    int count = 0;
    for (const SetUp::Joint& joint : set_up.joints) count += joint.sense < 0 ? 1 : 0;
    return count == 0 ? 0 : kOneCause + (count - 1);
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (set_up.joints[j].sense > 0) continue;
      set_ups->push_back(set_up);
      set_ups->back().joints[j].sense = 1;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    SetupCause cause;
    cause.kind = name();
    std::vector<int> joints;
    for (int j = 0; j < files.num_joints(); ++j) {
      if (set_up.joints[static_cast<std::size_t>(j)].sense < 0) joints.push_back(j);
    }
    if (joints.empty()) return;
    std::string lines;
    for (const int j : joints) {
      const JointRow& row = files.robot().joints[static_cast<std::size_t>(j)];
      cause.joints.push_back(j + 1);
      lines += fmt::format("{}{}", lines.empty() ? "" : ", ", row.where.line);
    }
    const JointRow& first = files.robot().joints[static_cast<std::size_t>(joints.front())];
    cause.sentence = fmt::format(
        "{} {} the other way", JointList(files, joints), joints.size() == 1 ? "counts" : "count");
    cause.where = first.where;
    cause.text = first.sign > 0 ? "sign: -1" : "sign: 1";
    if (files.spec.urdf) cause.text = "<axis> with the opposite numbers";
    if (joints.size() > 1) cause.text += fmt::format("   (lines {})", lines);
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      files->spec.robot.joints[j].sign *= set_up.joints[j].sense;
    }
  }
};

}  // namespace

const CauseKind& JointSense() {
  static const JointSenseKind kind;
  return kind;
}

}  // namespace dhcal
