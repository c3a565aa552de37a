// Joint angles in radians under the name of degrees, or the reverse.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/setup/cause.h"
#include "problems/setup/flange_poses.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr double kMostTurned = 4 * kPi;  // [rad] no joint of an arm turns further

class JointUnitKind : public CauseKind {
 public:
  std::string name() const override { return "unit"; }
  bool spoils_all() const override { return true; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    const int n = files.num_joints();
    // All of them, the wrist, and each alone.
    for (const AngleUnit unit : {AngleUnit::kHoldsRadians, AngleUnit::kHoldsDegrees}) {
      std::vector<std::pair<int, int>> ranges = {{0, n}};
      if (n > 3) ranges.insert(ranges.end(), {{n - 3, n}, {0, n - 3}});
      for (int j = 0; j < n; ++j) ranges.emplace_back(j, j + 1);
      for (const auto& [begin, end] : ranges) {
        if (auto changed = InUnit(files, from, unit, begin, end)) {
          set_ups->push_back(std::move(*changed));
        }
      }
    }
  }
  int Weight(const SetUp& set_up) const override {
    // Columns that follow each other were written by one hand.
    int count = 0;
    AngleUnit before = AngleUnit::kAsWritten;
    for (const SetUp::Joint& joint : set_up.joints) {
      count += joint.unit != before && joint.unit != AngleUnit::kAsWritten ? 1 : 0;
      before = joint.unit;
    }
    return kOneCause * count;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (Weight(set_up) == 0) return;
    set_ups->push_back(set_up);
    for (SetUp::Joint& joint : set_ups->back().joints) joint.unit = AngleUnit::kAsWritten;
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (set_up.joints[j].unit == AngleUnit::kAsWritten) continue;
      set_ups->push_back(set_up);
      set_ups->back().joints[j].unit = AngleUnit::kAsWritten;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    for (const AngleUnit unit : {AngleUnit::kHoldsRadians, AngleUnit::kHoldsDegrees}) {
      const bool radians = unit == AngleUnit::kHoldsRadians;
      std::vector<int> columns;
      for (const SetUp::Joint& joint : set_up.joints) {
        if (joint.unit == unit) columns.push_back(joint.column);
      }
      if (columns.empty()) continue;
      std::sort(columns.begin(), columns.end());
      SetupCause cause;
      cause.kind = name();
      std::string names, renamed;
      for (const int column : columns) {
        cause.joints.push_back(column + 1);
        names += (names.empty() ? "" : ", ") + JointColumn(files, column);
        renamed += fmt::format(
            "{}q{}_{}", renamed.empty() ? "" : ",", column + 1, radians ? "rad" : "deg");
      }
      cause.sentence = fmt::format("the column{} {} hold{} {}, not {}",
                                   columns.size() == 1 ? "" : "s",
                                   names,
                                   columns.size() == 1 ? "s" : "",
                                   radians ? "radians" : "degrees",
                                   radians ? "degrees" : "radians");
      cause.where = HeaderWhere(files);
      cause.text = renamed;
      causes->push_back(cause);
    }
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      // The order is cured before: column j is joint j's.
      files->recording.q.col(static_cast<Eigen::Index>(j)) *= FactorOf(set_up.joints[j].unit);
    }
  }

 private:
  /// Joints [begin, end) in another unit; nothing where that changes none of them, or where their
  /// columns leave what an arm turns.
  static std::optional<SetUp> InUnit(
      const Files& files, const SetUp& from, AngleUnit unit, int begin, int end) {
    SetUp changed = from;
    bool any = false;
    for (int j = begin; j < end; ++j) {
      if (!files.revolute(j)) continue;
      SetUp::Joint& joint = changed.joints[static_cast<std::size_t>(j)];
      const double most =
          files.recording.q.col(joint.column).cwiseAbs().maxCoeff() * FactorOf(unit);
      if (!(most <= kMostTurned)) return std::nullopt;
      any = any || joint.unit != unit;
      joint.unit = unit;
    }
    if (!any) return std::nullopt;
    return changed;
  }
};

}  // namespace

const CauseKind& JointUnit() {
  static const JointUnitKind kind;
  return kind;
}

}  // namespace dhcal
