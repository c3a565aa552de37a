// Readings in a left-handed frame: an axis counts the other way, or two columns are exchanged.
#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

class MirroredFrameKind : public CauseKind {
 public:
  std::string name() const override { return "mirrored_frame"; }
  void Neighbours(const Files& /*files*/,
                  const SetUp& /*from*/,
                  std::vector<SetUp>* /*set_ups*/) const override {}  // the fit finds it
  int Weight(const SetUp& set_up) const override { return set_up.mirrored ? kOneCause : 0; }
  void Undo(const SetUp& /*set_up*/, std::vector<SetUp>* /*set_ups*/) const override {}
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    if (!set_up.mirrored) return;
    const auto name_of = [&](std::size_t k, const char* otherwise) {
      return k < files.recording.p_names.size() ? files.recording.p_names[k]
                                                : std::string(otherwise);
    };
    SetupCause cause;
    cause.kind = name();
    cause.sentence =
        "the readings are in a left-handed frame: two of their columns are exchanged, or one "
        "counts "
        "the other way (which of them, base and tool cannot tell)";
    cause.where = HeaderWhere(files);
    cause.text =
        fmt::format("exchange the names {} and {}", name_of(1, "y_mm"), name_of(2, "z_mm"));
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    if (!set_up.mirrored) return;
    for (Eigen::MatrixXd* const points : {&files->recording.p_WQ, &files->recording.displacement}) {
      if (points->rows() > 0) points->col(1).swap(points->col(2));
    }
  }
};

}  // namespace

const CauseKind& MirroredFrame() {
  static const MirroredFrameKind kind;
  return kind;
}

}  // namespace dhcal
