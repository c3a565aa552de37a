// The frames at the two ends of the chain: one base and one tool, or one per run, target or edge.
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

  /// Ends of the chain for rows with these labels.
  EndFrames ends(const RowLabels& row) const { return {base(row), tool(row)}; }
  const Eigen::Isometry3d& base(const RowLabels& row) const { return bases_[BaseIndex(row)]; }
  const Eigen::Isometry3d& tool(const RowLabels& row) const { return tools_[ToolIndex(row)]; }
  Eigen::Isometry3d& mutable_base(const RowLabels& row) { return bases_[BaseIndex(row)]; }
  Eigen::Isometry3d& mutable_tool(const RowLabels& row) { return tools_[ToolIndex(row)]; }

  /// One, or one per run or edge of the recording.
  const std::vector<Eigen::Isometry3d>& bases() const { return bases_; }
  bool base_per_run() const { return base_per_run_; }
  bool tool_per_run() const { return tool_per_run_; }

  /// Adds a state's corrections of base and tool to the frames.
  void Apply(const std::vector<Parameter>& parameters,
             const Eigen::VectorXd& state,
             const SlotLayout& slots);

  /// Writes the frames back into a robot.
  void Store(const Recording& recording, RobotModel* robot) const;

 private:
  std::size_t BaseIndex(const RowLabels& row) const {
    if (base_per_edge_) return static_cast<std::size_t>(row.edge);
    return base_per_run_ ? static_cast<std::size_t>(row.run) : 0;
  }
  std::size_t ToolIndex(const RowLabels& row) const {
    if (tool_per_run_) return static_cast<std::size_t>(row.run);
    return tools_.size() > 1 ? static_cast<std::size_t>(row.target) : 0;
  }

  bool base_per_edge_;
  bool base_per_run_;
  bool tool_per_run_;
  std::vector<Eigen::Isometry3d> bases_;
  std::vector<Eigen::Isometry3d> tools_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FRAMES_H_
