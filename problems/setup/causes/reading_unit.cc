// Lengths of the readings under the name of another unit.
#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/length_units.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

class ReadingUnitKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  void Neighbours(const Files& /*files*/,
                  const SetUp& /*from*/,
                  std::vector<SetUp>* /*set_ups*/) const override {}  // the fit finds it
  int Weight(const SetUp& set_up) const override {
    return set_up.reading_scale == 1 ? 0 : kOneCause;
  }
  void Undo(const SetUp& /*set_up*/, std::vector<SetUp>* /*set_ups*/) const override {}
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (set_up.reading_scale == 1) return;
    const double scale = set_up.reading_scale;
    const LengthUnitWords words = WordsOfLengthUnit(scale);
    SetupCause cause;
    cause.kind = name();
    std::string names;
    for (const std::string& column : files.recording.p_names) {
      names += (names.empty() ? "" : ", ") + column;
    }
    names = names.empty() ? std::string("the readings ending in ") + words.named
                          : "the columns " + names;
    cause.sentence = fmt::format("{} hold {}: the readings are {:.4g} times too {}",
                                 names,
                                 words.holds,
                                 scale > 1 ? scale : 1 / scale,
                                 scale > 1 ? "small" : "large");
    cause.where = HeaderWhere(files);
    cause.text = *words.correct == '\0'
                     ? std::string("multiply these columns by 25.4 and name them _mm")
                     : fmt::format("x{0},y{0},z{0}", words.correct);
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    const double scale = set_up.reading_scale;
    if (scale == 1) return;
    files->recording.p_WQ *= scale;
    files->recording.displacement *= scale;
    files->recording.distance *= scale;
  }
};

}  // namespace

const CauseKind& ReadingUnit() {
  static const ReadingUnitKind kind;
  return kind;
}

}  // namespace dhcal
