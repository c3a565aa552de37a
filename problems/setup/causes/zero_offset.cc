// A joint whose zero lies off the table's: a quarter or half turn, which is tried as a step, or any
// angle, which the search finds where no steps help (SetUpSearch::Remastered).
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/setup/cause.h"
#include "problems/setup/flange_poses.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

double OffsetOf(const SetUp::Joint& joint) { return joint.quarters * kPi / 2 + joint.offset; }

bool IsOff(const SetUp::Joint& joint) { return joint.quarters != 0 || joint.offset != 0; }

/// [deg] Exact for quarter turns; an angle that was fitted is known no better than to a tenth, and
/// the calibration finds the rest.
double InTenths(double degrees, const SetUp::Joint& joint) {
  return joint.offset == 0 ? degrees : std::round(10 * degrees) / 10;
}

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
    int weight = 0;
    for (const SetUp::Joint& joint : set_up.joints) {
      // Any angle can fit more than four can.
      if (IsOff(joint)) weight += joint.offset != 0 ? kOneCause + 1 : kOneCause;
    }
    return weight;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (!IsOff(set_up.joints[j])) continue;
      set_ups->push_back(set_up);
      set_ups->back().joints[j].quarters = 0;
      set_ups->back().joints[j].offset = 0;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    for (int j = 0; j < files.num_joints(); ++j) {
      const SetUp::Joint& joint = set_up.joints[static_cast<std::size_t>(j)];
      if (!IsOff(joint)) continue;
      const double off = OffsetOf(joint) / kDegree;
      const JointRow& row = files.robot().joints[static_cast<std::size_t>(j)];
      SetupCause cause;
      cause.kind = name();
      cause.joints = {j + 1};
      cause.sentence = fmt::format("the zero of {} lies {} deg from the table's",
                                   JointList(files, {j}),
                                   fmt::format("{:+g}", InTenths(off, joint)));
      cause.where = row.where;
      cause.text = fmt::format(
          "theta_deg: {:g}",
          InTenths(std::remainder(FactorOf(set_up.table_unit) * row.theta / kDegree + off, 360),
                   joint));
      if (files.spec.urdf) {
        cause.text = fmt::format("<origin> turned by {:+g} deg about the joint's axis",
                                 InTenths(off, joint));
      }
      causes->push_back(cause);
    }
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      files->spec.robot.joints[j].theta += OffsetOf(set_up.joints[j]);
    }
  }
};

}  // namespace

const CauseKind& ZeroOffset() {
  static const ZeroOffsetKind kind;
  return kind;
}

}  // namespace dhcal
