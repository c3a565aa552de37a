// One kind of thing that a file may say wrongly. A new kind is one file in causes/ and one line in
// registry.cc.
#ifndef DHCAL_PROBLEMS_SETUP_CAUSE_H_
#define DHCAL_PROBLEMS_SETUP_CAUSE_H_

#include <string>
#include <vector>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/setup.h"
#include "problems/setup/set_up.h"

namespace dhcal {

/// The files that a set-up is of.
struct Files {
  const ProblemSpec& spec;
  const Recording& recording;

  const RobotModel& robot() const { return spec.robot; }
  int num_joints() const { return spec.robot.num_joints(); }
  bool revolute(int joint_idx) const {
    return spec.robot.joints[static_cast<std::size_t>(joint_idx)].type == JointType::kRevolute;
  }
};

/// Files that a cure may change: copies in memory.
struct CuredFiles {
  ProblemSpec spec;
  Recording recording;
};

constexpr int kOneCause = 2;

class CauseKind {
 public:
  virtual ~CauseKind() = default;

  /// "joint_sense": as in result.json.
  virtual std::string name() const = 0;
  /// Adds the set-ups that one step of this kind makes of `from`.
  virtual void Neighbours(const Files& files,
                          const SetUp& from,
                          std::vector<SetUp>* set_ups) const = 0;
  /// Adds set-ups that single steps of this kind may not reach from `from`.
  virtual void FarJumps(const Files& /*files*/,
                        const SetUp& /*from*/,
                        std::vector<SetUp>* /*set_ups*/) const {}
  /// True for a kind that makes all poses wrong: the other kinds are tried under it, too.
  virtual bool spoils_all() const { return false; }
  /// How much of this kind a set-up changes: kOneCause for a thing by itself, less for more of the
  /// same hand; 0 for none.
  virtual int Weight(const SetUp& set_up) const = 0;
  /// Adds the set-ups with one thing of this kind less.
  virtual void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const = 0;
  /// Adds one cause with its sentence and line; nothing where Weight is 0.
  virtual void Describe(const Files& files,
                        const SetUp& set_up,
                        std::vector<SetupCause>* causes) const = 0;
  /// Makes the files say what the set-up takes them for.
  virtual void Cure(const SetUp& set_up, CuredFiles* files) const = 0;
};

/// All kinds, in the order in which they are told.
const std::vector<const CauseKind*>& CauseKinds();

/// Of all kinds together.
int WeightOf(const SetUp& set_up);

/// Copies of the files that say what the set-up takes them for.
CuredFiles Cured(const Files& files, const SetUp& set_up);

// The kinds. Each is defined in its own file.
const CauseKind& Convention();
const CauseKind& JointOrder();
const CauseKind& JointSense();
const CauseKind& ZeroOffset();
const CauseKind& TurnsWithAnother();
const CauseKind& JointUnit();
const CauseKind& TableUnit();
const CauseKind& TableLength();
const CauseKind& ReadingUnit();
const CauseKind& ToolUnit();
const CauseKind& MirroredFrame();
const CauseKind& RowShift();
const CauseKind& FramePerRun();

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_CAUSE_H_
