// An instrument or a tool that was set up anew between the runs of a recording.
#include "problems/setup/cause.h"

namespace dhcal {
namespace {

class FramePerRunKind : public CauseKind {
 public:
  std::string name() const override { return "frame_per_run"; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    if (files.recording.run_names.size() < 2) return;
    if (!files.robot().base_per_run && !from.base_per_run) {
      set_ups->push_back(from);
      set_ups->back().base_per_run = true;
    }
    if (!files.robot().tool_per_run && !from.tool_per_run && files.robot().targets.empty()) {
      set_ups->push_back(from);
      set_ups->back().tool_per_run = true;
    }
  }
  int Weight(const SetUp& set_up) const override {
    return kOneCause * ((set_up.base_per_run ? 1 : 0) + (set_up.tool_per_run ? 1 : 0));
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    if (set_up.base_per_run) {
      set_ups->push_back(set_up);
      set_ups->back().base_per_run = false;
    }
    if (set_up.tool_per_run) {
      set_ups->push_back(set_up);
      set_ups->back().tool_per_run = false;
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    const auto add = [&](const char* frame, const char* what) {
      std::string runs;
      for (const std::string& run : files.recording.run_names) {
        runs += (runs.empty() ? "" : ", ") + run;
      }
      SetupCause cause;
      cause.kind = name();
      cause.sentence = std::string("the runs ") + runs + " fit one by one but not together: the " +
                       what + " between them";
      cause.where = files.robot().where;
      cause.text = std::string(frame) + ": {per_run: true}";
      causes->push_back(cause);
    };
    if (set_up.base_per_run) add("base", "instrument was set up anew, or the robot moved,");
    if (set_up.tool_per_run) add("tool", "tool or its reflector was mounted anew");
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    files->spec.robot.base_per_run |= set_up.base_per_run;
    files->spec.robot.tool_per_run |= set_up.tool_per_run;
  }
};

}  // namespace

const CauseKind& FramePerRun() {
  static const FramePerRunKind kind;
  return kind;
}

}  // namespace dhcal
