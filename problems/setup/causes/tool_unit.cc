// Lengths of the tool under the name of another unit.
#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/setup/cause.h"
#include "problems/setup/length_units.h"

namespace dhcal {
namespace {

class ToolUnitKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  void Neighbours(const Files& /*files*/,
                  const SetUp& /*from*/,
                  std::vector<SetUp>* /*set_ups*/) const override {}  // the fit finds it
  int Weight(const SetUp& set_up) const override { return set_up.tool_scale == 1 ? 0 : kOneCause; }
  void Undo(const SetUp& /*set_up*/, std::vector<SetUp>* /*set_ups*/) const override {}
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (Weight(set_up) == 0) return;
    const Eigen::Vector3d stated = files.robot().X_TQ.translation();
    const Eigen::Vector3d meant = set_up.tool_scale * stated / kMillimetre;
    SetupCause cause;
    cause.kind = name();
    cause.sentence =
        fmt::format("the tool's lengths hold {}: as they stand it would be {:.3g} m long",
                    WordsOfLengthUnit(set_up.tool_scale).holds,
                    stated.norm());
    cause.where = files.robot().where;
    cause.text =
        fmt::format("tool: {{xyz_mm: [{:g}, {:g}, {:g}]}}", meant.x(), meant.y(), meant.z());
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    files->spec.robot.X_TQ.translation() *= set_up.tool_scale;
  }
};

}  // namespace

const CauseKind& ToolUnit() {
  static const ToolUnitKind kind;
  return kind;
}

}  // namespace dhcal
