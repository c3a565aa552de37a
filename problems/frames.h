// The frames at the two ends of the chain: one base and one tool, or one per run or target.
#ifndef DHCAL_PROBLEMS_FRAMES_H_
#define DHCAL_PROBLEMS_FRAMES_H_

#include <vector>

#include <Eigen/Geometry>

#include "core/kinematics/dh_chain.h"
#include "core/model/parameter.h"
#include "core/model/recording.h"
#include "core/model/robot.h"

namespace dhcal {

class Frames {
 public:
  /// The nominal frames of the problem file.
  Frames(const RobotModel& robot, const Recording& recording);

  /// Ends of the chain for rows of this run and target.
  EndFrames ends(int run, int target) const { return {base(run), tool(run, target)}; }
  const Eigen::Isometry3d& base(int run) const { return bases_[BaseIndex(run)]; }
  const Eigen::Isometry3d& tool(int run, int target) const {
    return tools_[ToolIndex(run, target)];
  }
  Eigen::Isometry3d& mutable_base(int run) { return bases_[BaseIndex(run)]; }
  Eigen::Isometry3d& mutable_tool(int run, int target) { return tools_[ToolIndex(run, target)]; }

  std::size_t num_bases() const { return bases_.size(); }
  bool base_per_run() const { return base_per_run_; }
  bool tool_per_run() const { return tool_per_run_; }

  /// Adds a state's corrections of base and tool to the frames.
  void Apply(const std::vector<Parameter>& parameters,
             const Eigen::VectorXd& state,
             const SlotLayout& slots);

  /// Writes the frames back into a robot.
  void Store(const Recording& recording, RobotModel* robot) const;

 private:
  std::size_t BaseIndex(int run) const { return base_per_run_ ? static_cast<std::size_t>(run) : 0; }
  std::size_t ToolIndex(int run, int target) const {
    if (tool_per_run_) return static_cast<std::size_t>(run);
    return tools_.size() > 1 ? static_cast<std::size_t>(target) : 0;
  }

  bool base_per_run_;
  bool tool_per_run_;
  std::vector<Eigen::Isometry3d> bases_;
  std::vector<Eigen::Isometry3d> tools_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FRAMES_H_
