// Angles of the table in radians under the name of degrees, or the reverse.
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/setup/cause.h"
#include "problems/setup/flange_poses.h"

namespace dhcal {
namespace {

class TableUnitKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  bool spoils_all() const override { return true; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    if (files.spec.urdf) return;  // which has one unit only
    double most = 0;
    for (const JointRow& row : files.robot().joints) {
      most = std::max({most, std::abs(row.alpha), std::abs(row.theta)});
    }
    for (const AngleUnit unit : {AngleUnit::kHoldsRadians, AngleUnit::kHoldsDegrees}) {
      // No table writes more than a turn.
      if (most == 0 || most * FactorOf(unit) > 2 * kPi) continue;
      set_ups->push_back(from);
      set_ups->back().table_unit = unit;
    }
  }
  int Weight(const SetUp& set_up) const override {
    return set_up.table_unit == AngleUnit::kAsWritten ? 0 : kOneCause;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (Weight(set_up) == 0) return;
    set_ups->push_back(set_up);
    set_ups->back().table_unit = AngleUnit::kAsWritten;
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (Weight(set_up) == 0) return;
    const bool radians = set_up.table_unit == AngleUnit::kHoldsRadians;
    const double unit = radians ? kDegree : 1;
    std::string example;
    for (const JointRow& row : files.robot().joints) {
      const double angle = row.alpha != 0 ? row.alpha : row.theta;
      if (angle == 0 || !example.empty()) continue;
      example = fmt::format(
          ": {:.5g} is {:.4g} deg", angle / unit, angle * FactorOf(set_up.table_unit) / kDegree);
    }
    SetupCause cause;
    cause.kind = name();
    cause.sentence = fmt::format("the table's theta and alpha are in {}, not in {}{}",
                                 radians ? "radians" : "degrees",
                                 radians ? "degrees" : "radians",
                                 example);
    cause.where = files.robot().joints.front().where;
    cause.text =
        fmt::format("theta_{0}: ..., alpha_{0}: ...   (in every row)", radians ? "rad" : "deg");
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (JointRow& row : files->spec.robot.joints) {
      row.theta *= FactorOf(set_up.table_unit);
      row.alpha *= FactorOf(set_up.table_unit);
    }
  }
};

}  // namespace

const CauseKind& TableUnit() {
  static const TableUnitKind kind;
  return kind;
}

}  // namespace dhcal
