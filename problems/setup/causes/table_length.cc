// Lengths of the table under the name of another unit.
#include <algorithm>

#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/length_units.h"

namespace dhcal {
namespace {

class TableLengthKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  /// Where nothing slides the fit finds it; a slide's coordinate keeps its own unit.
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    if (files.spec.urdf) return;  // which has one unit only
    const bool slides = std::any_of(
        files.robot().joints.begin(), files.robot().joints.end(), [](const JointRow& row) {
          return row.type == JointType::kPrismatic;
        });
    if (!slides) return;
    for (const double scale : {1e3, 1e-3}) {
      const std::optional<LengthFactors> units = UnitsOf(files.robot(), 1 / scale);
      if (scale == from.table_scale || !units || units->table != scale) continue;
      set_ups->push_back(from);
      set_ups->back().table_scale = scale;
    }
  }
  bool spoils_all() const override { return true; }
  int Weight(const SetUp& set_up) const override { return set_up.table_scale == 1 ? 0 : kOneCause; }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (Weight(set_up) == 0) return;
    set_ups->push_back(set_up);
    set_ups->back().table_scale = 1;
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (Weight(set_up) == 0) return;
    const LengthUnitWords words = WordsOfLengthUnit(set_up.table_scale);
    SetupCause cause;
    cause.kind = name();
    cause.sentence = fmt::format(
        "the table's lengths ending in {} hold {}: as they stand the robot would reach {:.3g} m",
        words.named,
        words.holds,
        TableReach(files.robot()));
    cause.where = files.robot().joints.front().where;
    cause.text = *words.correct == '\0'
                     ? std::string("multiply the table's lengths by 25.4 and name them _mm")
                     : fmt::format("d{0}: ..., a{0}: ...   (in every row)", words.correct);
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (JointRow& row : files->spec.robot.joints) {
      row.a *= set_up.table_scale;
      row.d *= set_up.table_scale;
    }
  }
};

}  // namespace

const CauseKind& TableLength() {
  static const TableLengthKind kind;
  return kind;
}

}  // namespace dhcal
