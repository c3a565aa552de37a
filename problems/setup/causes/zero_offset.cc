// A joint whose zero lies a quarter or half turn from the table's.
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/setup/cause.h"
#include "problems/setup/flange_poses.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

class ZeroOffsetKind : public CauseKind {
 public:
  std::string name() const override { return "zero_offset"; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    for (int j = 0; j < files.num_joints(); ++j) {
      if (!files.revolute(j)) continue;
      const auto idx = static_cast<std::size_t>(j);
      for (int quarters = -1; quarters <= 2; ++quarters) {
        if (quarters == from.joints[idx].quarters) continue;
        set_ups->push_back(from);
        set_ups->back().joints[idx].quarters = quarters;
      }
    }
  }
  int Weight(const SetUp& set_up) const override {
    int count = 0;
    for (const SetUp::Joint& joint : set_up.joints) count += joint.quarters != 0 ? 1 : 0;
    return kOneCause * count;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (set_up.joints[j].quarters == 0) continue;
      set_ups->push_back(set_up);
      set_ups->back().joints[j].quarters = 0;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    for (int j = 0; j < files.num_joints(); ++j) {
      const int quarters = set_up.joints[static_cast<std::size_t>(j)].quarters;
      if (quarters == 0) continue;
      const JointRow& row = files.robot().joints[static_cast<std::size_t>(j)];
      SetupCause cause;
      cause.kind = name();
      cause.joints = {j + 1};
      cause.sentence = fmt::format(
          "the zero of {} lies {:+d} deg from the table's", JointList(files, {j}), 90 * quarters);
      cause.where = row.where;
      cause.text = fmt::format(
          "theta_deg: {:g}",
          std::remainder(FactorOf(set_up.table_unit) * row.theta / kDegree + 90 * quarters, 360));
      causes->push_back(cause);
    }
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      files->spec.robot.joints[j].theta += set_up.joints[j].quarters * kPi / 2;
    }
  }
};

}  // namespace

const CauseKind& ZeroOffset() {
  static const ZeroOffsetKind kind;
  return kind;
}

}  // namespace dhcal
