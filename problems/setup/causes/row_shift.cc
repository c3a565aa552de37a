// Readings that stand a row or two beside their joint coordinates: one was lost, or read twice.
#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "problems/setup/cause.h"

namespace dhcal {
namespace {

int LineOf(const Recording& recording, int row) {
  const auto idx = static_cast<std::size_t>(row);
  return idx < recording.lines.size() ? recording.lines[idx] : 0;
}

class RowShiftKind : public CauseKind {
 public:
  std::string name() const override { return "row_shift"; }
  bool spoils_all() const override { return true; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    if (files.spec.measurement.kind.pairs) return;
    for (int shift = -kMostRowShift; shift <= kMostRowShift; ++shift) {
      if (shift == from.shift) continue;
      set_ups->push_back(from);
      set_ups->back().shift = shift;
    }
  }
  int Weight(const SetUp& set_up) const override { return set_up.shift != 0 ? kOneCause : 0; }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (set_up.shift == 0) return;
    set_ups->push_back(set_up);
    set_ups->back().shift = 0;
    set_ups->back().shift_from = 0;
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (set_up.shift == 0) return;
    const int by = std::abs(set_up.shift);
    const bool later = set_up.shift > 0;
    SetupCause cause;
    cause.kind = name();
    const std::string from = set_up.shift_from > 0
                                 ? fmt::format("from row {} (line {}) on, ",
                                               set_up.shift_from + 1,
                                               LineOf(files.recording, set_up.shift_from))
                                 : std::string();
    cause.sentence =
        fmt::format("{}each reading belongs to the joint angles {} {}",
                    from,
                    by == 1 ? "one row" : fmt::format("{} rows", by),
                    later ? "later: a reading is missing there"
                          : "earlier: a reading stands there twice, or a pose is missing");
    cause.where = {files.recording.file, LineOf(files.recording, set_up.shift_from), 0};
    cause.text = fmt::format("move the readings {} by {}, from this line to the end of the run",
                             later ? "down" : "up",
                             by == 1 ? "one row" : fmt::format("{} rows", by));
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    if (set_up.shift == 0) return;
    Recording& recording = files->recording;
    for (Eigen::MatrixXd* const readings : {&recording.p_WQ, &recording.quaternion}) {
      if (readings->rows() == 0) continue;
      const Eigen::MatrixXd before = *readings;
      for (int row = set_up.shift_from; row < recording.num_rows(); ++row) {
        readings->row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
        const int from = row - set_up.shift;
        const bool same = from >= set_up.shift_from && from < recording.num_rows() &&
                          recording.run(from) == recording.run(row);
        if (same) readings->row(row) = before.row(from);
      }
    }
    if (recording.distance.size() == 0) return;
    const Eigen::VectorXd before = recording.distance;
    for (int row = set_up.shift_from; row < recording.num_rows(); ++row) {
      const int from = row - set_up.shift;
      const bool same = from >= set_up.shift_from && from < recording.num_rows() &&
                        recording.run(from) == recording.run(row);
      recording.distance[row] = same ? before[from] : std::numeric_limits<double>::quiet_NaN();
    }
  }
};

}  // namespace

const CauseKind& RowShift() {
  static const RowShiftKind kind;
  return kind;
}

}  // namespace dhcal
