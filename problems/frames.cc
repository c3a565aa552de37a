#include "problems/frames.h"

#include <algorithm>
#include <optional>
#include <string>

namespace dhcal {
namespace {

std::size_t NumRuns(const Recording& recording) {
  return std::max<std::size_t>(recording.run_names.size(), 1);
}

/// One frame, or one per run: the file's start for that run, else the common one.
std::vector<Eigen::Isometry3d> PerRun(bool per_run,
                                      const Eigen::Isometry3d& common,
                                      const std::vector<RunFrame>& starts,
                                      const Recording& recording) {
  std::vector<Eigen::Isometry3d> frames(per_run ? NumRuns(recording) : 1, common);
  for (std::size_t run = 0; per_run && run < recording.run_names.size(); ++run) {
    for (const RunFrame& start : starts) {
      if (start.run == recording.run_names[run]) frames[run] = start.X;
    }
  }
  return frames;
}

/// X_EB of every edge of the recording; of one whose pose nobody knows X_WB.
std::vector<Eigen::Isometry3d> PerEdge(const RobotModel& robot, const Recording& recording) {
  std::vector<Eigen::Isometry3d> frames(std::max<std::size_t>(recording.edge_names.size(), 1),
                                        robot.X_WB);
  for (std::size_t edge = 0; edge < recording.edge_names.size(); ++edge) {
    for (const Edge& known : robot.edges) {
      if (known.name != recording.edge_names[edge] || !known.X_WE) continue;
      frames[edge] = known.X_WE->inverse() * robot.X_WB;
    }
  }
  return frames;
}

/// The edges of the file, those of the recording where these bases have them.
void StorePerEdge(const std::vector<Eigen::Isometry3d>& bases,
                  const Recording& recording,
                  RobotModel* robot) {
  for (std::size_t k = 0; k < recording.edge_names.size(); ++k) {
    const std::string& name = recording.edge_names[k];
    auto edge = std::find_if(robot->edges.begin(), robot->edges.end(), [&](const Edge& known) {
      return known.name == name;
    });
    if (edge == robot->edges.end()) edge = robot->edges.insert(edge, Edge{name, std::nullopt});
    edge->X_WE = robot->X_WB * bases[k].inverse();
  }
}

std::vector<RunFrame> StorePerRun(const std::vector<Eigen::Isometry3d>& frames,
                                  const Recording& recording) {
  std::vector<RunFrame> stored;
  for (std::size_t run = 0; run < recording.run_names.size(); ++run) {
    stored.push_back({recording.run_names[run], frames[run]});
  }
  return stored;
}

}  // namespace

Frames::Frames(const RobotModel& robot, const Recording& recording)
    : base_per_edge_(robot.base_per_edge),
      base_per_run_(robot.base_per_run),
      tool_per_run_(robot.tool_per_run),
      bases_(base_per_edge_ ? PerEdge(robot, recording)
                            : PerRun(base_per_run_, robot.X_WB, robot.base_of_run, recording)),
      tools_(PerRun(tool_per_run_, robot.X_TQ, robot.tool_of_run, recording)) {
  if (robot.targets.empty()) return;
  tools_.clear();
  for (const Target& target : robot.targets) tools_.push_back(target.X_TQ);
}

void Frames::Apply(const std::vector<Parameter>& parameters,
                   const Eigen::VectorXd& state,
                   const SlotLayout& slots) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  std::vector<Vector6> base_delta(bases_.size(), Vector6::Zero());
  std::vector<Vector6> tool_delta(tools_.size(), Vector6::Zero());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    const double value = state[static_cast<Eigen::Index>(k)];
    if (p.group == ParameterGroup::kBase) {
      base_delta[BaseIndex(p.scope.row())][p.slot - slots.base(0)] = value;
    } else if (p.group == ParameterGroup::kTool) {
      tool_delta[ToolIndex(p.scope.row())][p.slot - slots.tool(0)] = value;
    }
  }
  for (std::size_t k = 0; k < bases_.size(); ++k) {
    bases_[k] = PerturbFrame<double>(bases_[k], base_delta[k]);
  }
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    tools_[k] = PerturbFrame<double>(tools_[k], tool_delta[k]);
  }
}

void Frames::Store(const Recording& recording, RobotModel* robot) const {
  if (base_per_edge_) {
    StorePerEdge(bases_, recording, robot);
  } else {
    robot->X_WB = bases_[0];
  }
  if (base_per_run_) robot->base_of_run = StorePerRun(bases_, recording);
  if (tool_per_run_) robot->tool_of_run = StorePerRun(tools_, recording);
  if (robot->targets.empty()) {
    robot->X_TQ = tools_[0];
    return;
  }
  for (std::size_t k = 0; k < robot->targets.size(); ++k) robot->targets[k].X_TQ = tools_[k];
}

}  // namespace dhcal
