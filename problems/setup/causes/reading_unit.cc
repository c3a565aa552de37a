// Lengths of the readings or of the table under the name of another unit. Only their ratio shows;
// which of the two is wrong is told by the robot's size.
#include <cmath>

#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr double kInch = 25.4;                              // [mm]
constexpr double kSmallestReach = 0.1, kLargestReach = 30;  // [m] of arms

double Reach(const RobotModel& robot) {
  double reach = 0;
  for (const JointRow& row : robot.joints) reach += std::hypot(row.a, row.d);
  return reach;
}

bool Near(double a, double b) { return std::abs(a / b - 1) < 1e-6; }

/// True where the table is wrong, not the readings.
bool OfTable(const RobotModel& robot, double scale) {
  if (Near(scale, kInch) || Near(scale, kInch / 1000)) return false;
  if (Near(scale, 1 / kInch) || Near(scale, 1000 / kInch)) return true;
  const double reach = Reach(robot);
  return reach < kSmallestReach || reach > kLargestReach;
}

/// What lengths hold that are so many times too small: {"metres", "_mm", "_m"}.
struct UnitWords {
  const char* holds;
  const char* named;    // ending that the name has
  const char* correct;  // ending that it should have; "" = there is none
};
UnitWords WordsOf(double factor) {
  if (Near(factor, 1000)) return {"metres", "_mm", "_m"};
  if (Near(factor, 1e-3)) return {"millimetres", "_m", "_mm"};
  if (Near(factor, kInch)) return {"inches", "_mm", ""};
  return {"inches", "_m", ""};
}

class ReadingUnitKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  void Neighbours(const Files& /*files*/,
                  const SetUp& /*from*/,
                  std::vector<SetUp>* /*set_ups*/) const override {}  // the fit finds it
  int Count(const SetUp& set_up) const override { return set_up.reading_scale == 1 ? 0 : 1; }
  void Undo(const SetUp& /*set_up*/, std::vector<SetUp>* /*set_ups*/) const override {}
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (set_up.reading_scale == 1) return;
    const bool table = OfTable(files.robot(), set_up.reading_scale);
    const UnitWords words = WordsOf(table ? 1 / set_up.reading_scale : set_up.reading_scale);
    SetupCause cause;
    cause.kind = name();
    if (table) {
      cause.sentence =
          fmt::format("the table's lengths ending in {} hold {}: the robot would reach {:.3g} m",
                      words.named,
                      words.holds,
                      Reach(files.robot()));
      cause.where = files.robot().joints.front().where;
      cause.text = *words.correct == '\0'
                       ? "multiply the table's lengths by 25.4 and name them _mm"
                       : fmt::format("d{0}: ..., a{0}: ...   (in every row)", words.correct);
    } else {
      std::string names;
      for (const std::string& column : files.recording.p_names) {
        names += (names.empty() ? "" : ", ") + column;
      }
      if (names.empty()) names = std::string("the readings ending in ") + words.named;
      cause.sentence =
          fmt::format("{} hold {}: the readings are {:.4g} times too {}",
                      names,
                      words.holds,
                      set_up.reading_scale > 1 ? set_up.reading_scale : 1 / set_up.reading_scale,
                      set_up.reading_scale > 1 ? "small" : "large");
      cause.where = HeaderWhere(files);
      cause.text = *words.correct == '\0'
                       ? std::string("multiply these columns by 25.4 and name them _mm")
                       : fmt::format("x{0},y{0},z{0}", words.correct);
    }
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    const double scale = set_up.reading_scale;
    if (scale == 1) return;
    if (OfTable(files->spec.robot, scale)) {
      for (JointRow& row : files->spec.robot.joints) {
        row.a /= scale;
        row.d /= scale;
      }
      return;
    }
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
