#include "tools/compensate/run.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/io/whole_file.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "tools/compensate/compensate.h"
#include "tools/compensate/expected_error.h"
#include "tools/compensate/real_arm.h"
#include "tools/compensate/wanted_poses.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

/// Files and flags, checked.
struct Inputs {
  ProblemSpec model;
  std::optional<ProblemSpec> nominal;
  Recording rows;
  PoseFrame frame = PoseFrame::kBase;
  Eigen::VectorXd seed;  // empty where not given
};

void CheckFlags(const CompensateOptions& options, Diagnostics* diagnostics) {
  const auto error = [&](const std::string& what) { diagnostics->Error({"command line"}, what); };
  if (options.model.empty()) error("--model is missing; give the calibrated.yaml of a result");
  if (options.poses.empty()) error("--poses is missing; give a table of wanted poses");
  if (options.frame != "base" && options.frame != "world") {
    error(fmt::format("--frame is '{}', but 'base' or 'world' is expected",
                      Printable(options.frame)));
  }
  if (options.predict && !options.nominal.empty()) {
    error("--predict evaluates the model alone; remove --nominal");
  }
}

/// "0,-90,90": one number per joint.
Eigen::VectorXd ReadSeed(const std::string& list,
                         const RobotModel& robot,
                         Diagnostics* diagnostics) {
  Eigen::VectorXd seed(0);
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    const std::optional<double> number = ParseDouble(item);
    const auto joint = static_cast<std::size_t>(seed.size());
    if (!number || joint >= robot.joints.size()) {
      diagnostics->Error({"command line"},
                         fmt::format("--seed_deg is '{}', but {} numbers with commas between them "
                                     "are expected",
                                     Printable(list),
                                     robot.num_joints()));
      return {};
    }
    const bool turns = robot.joints[joint].type == JointType::kRevolute;
    seed.conservativeResize(seed.size() + 1);
    seed.tail<1>()[0] = *number * (turns ? kDegree : kMillimetre);
  }
  if (seed.size() > 0 && seed.size() != robot.num_joints()) {
    diagnostics->Error({"command line"},
                       fmt::format("--seed_deg has {} numbers, but the robot has {} joints",
                                   seed.size(),
                                   robot.num_joints()));
  }
  return seed;
}

/// Where no edge is at hand the base of the file is the only one.
void LeaveEdges(ProblemSpec* spec) {
  spec->robot.base_per_edge = false;
  spec->robot.edges.clear();
}

std::optional<Inputs> ReadInputs(const CompensateOptions& options, Diagnostics* diagnostics) {
  CheckFlags(options, diagnostics);
  if (!diagnostics->ok()) return std::nullopt;
  Inputs inputs;
  inputs.frame = options.frame == "world" ? PoseFrame::kWorld : PoseFrame::kBase;
  std::optional<ProblemSpec> model = ReadProblemFile(options.model, options.data_dir, diagnostics);
  if (!model) return std::nullopt;
  inputs.model = std::move(*model);
  LeaveEdges(&inputs.model);
  if (!options.nominal.empty()) {
    inputs.nominal = ReadProblemFile(options.nominal, options.data_dir, diagnostics);
    if (!inputs.nominal) return std::nullopt;
    if (inputs.nominal->robot.num_joints() != inputs.model.robot.num_joints()) {
      diagnostics->Error({options.nominal},
                         fmt::format("has {} joints, but {} has {}; give the problem file that was "
                                     "calibrated",
                                     inputs.nominal->robot.num_joints(),
                                     Printable(options.model),
                                     inputs.model.robot.num_joints()));
    }
  }
  inputs.seed = ReadSeed(options.seed, inputs.model.robot, diagnostics);
  std::optional<Recording> rows = ReadPoses(options.poses, inputs.model.robot.joints, diagnostics);
  if (!rows || !diagnostics->ok()) return std::nullopt;
  inputs.rows = std::move(*rows);
  const bool needs_joints = options.predict || inputs.nominal.has_value();
  if (needs_joints && !inputs.rows.q.allFinite()) {
    diagnostics->Error({options.poses},
                       fmt::format("'{}' needs joint coordinates: columns q1_deg ... (of slides "
                                   "q1_mm)",
                                   options.predict ? "--predict" : "--nominal"));
    return std::nullopt;
  }
  return inputs;
}

/// Names of the table that the model does not have would be served by the wrong tool.
void CheckTargets(const Inputs& inputs, Diagnostics* diagnostics) {
  std::vector<std::string> known;
  for (const Target& target : inputs.model.robot.targets) known.push_back(target.name);
  if (known.empty()) return;
  for (const std::string& name : inputs.rows.target_names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    diagnostics->Error({inputs.rows.file},
                       fmt::format("the target '{}' is not defined in {}; it has {}",
                                   Printable(name),
                                   Printable(inputs.model.file),
                                   QuotedList(known, "and")));
  }
}

std::optional<Eigen::VectorXd> Expected(const CompensateOptions& options,
                                        const Inputs& inputs,
                                        const RealArm& arm,
                                        const Eigen::MatrixXd& q,
                                        Diagnostics* diagnostics) {
  const std::string beside = (fs::path(options.model).parent_path() / "result.json").string();
  const bool asked = !options.result.empty();
  std::error_code status;
  if (asked && !fs::exists(options.result, status)) {
    diagnostics->Error({options.result}, "there is no such file; --result names a result.json");
  }
  const auto known = ReadCovariance(asked ? options.result : beside, diagnostics);
  if (!known) return std::nullopt;
  return ExpectedErrors(inputs.model, inputs.rows, arm, q, *known);
}

/// To the file as a whole, or to `out`.
void Write(const std::string& text,
           const std::string& file,
           std::ostream& out,
           Diagnostics* diagnostics) {
  if (file.empty()) {
    out << text;
  } else {
    WriteWholeFile(file, text, diagnostics);
  }
}

std::vector<Eigen::Isometry3d> BasesOf(const RealArm& arm, const Recording& rows) {
  std::vector<Eigen::Isometry3d> bases;
  for (int row = 0; row < rows.num_rows(); ++row) bases.push_back(arm.ends(row).X_WB);
  return bases;
}

std::string Predictions(const CompensateOptions& options,
                        const Inputs& inputs,
                        const RealArm& arm,
                        Diagnostics* diagnostics) {
  const Eigen::MatrixXd& q = inputs.rows.q;
  const Eigen::MatrixXd deltas = arm.Deltas(q);
  std::vector<Eigen::Isometry3d> poses;
  for (int row = 0; row < inputs.rows.num_rows(); ++row) {
    const Eigen::Isometry3d X_WQ = arm.Pose(q, deltas, row);
    poses.push_back(inputs.frame == PoseFrame::kWorld ? X_WQ : arm.ends(row).X_WB.inverse() * X_WQ);
  }
  const auto expected = Expected(options, inputs, arm, q, diagnostics);
  return PosesToCsv(poses, expected.value_or(Eigen::VectorXd()));
}

/// Nothing where seeds or poses are missing.
std::optional<std::vector<Command>> Commands(const Inputs& inputs,
                                             const RealArm& arm,
                                             Diagnostics* diagnostics) {
  const std::vector<Eigen::Isometry3d> bases = BasesOf(arm, inputs.rows);
  const auto seeds = SeedsOf(inputs.rows, inputs.seed, diagnostics);
  const auto wanted = inputs.nominal
                          ? std::optional(NominalPoses(*inputs.nominal, inputs.rows, bases))
                          : WantedPoses(inputs.rows, bases, inputs.frame, diagnostics);
  if (!seeds || !wanted) return std::nullopt;
  return Compensate(arm, *wanted, *seeds);
}

}  // namespace

int RunCompensate(const CompensateOptions& options, std::ostream& out, std::ostream& messages) {
  Diagnostics diagnostics;
  const auto finish = [&](int status) {
    messages << diagnostics.ToString();
    return diagnostics.ok() ? status : kCompensateBadInput;
  };
  const std::optional<Inputs> inputs = ReadInputs(options, &diagnostics);
  if (!inputs) return finish(kCompensateBadInput);
  CheckTargets(*inputs, &diagnostics);
  if (!diagnostics.ok()) return finish(kCompensateBadInput);
  const RealArm arm(inputs->model, inputs->rows, &diagnostics);
  if (!diagnostics.ok()) return finish(kCompensateBadInput);

  if (options.predict) {
    const std::string table = Predictions(options, *inputs, arm, &diagnostics);
    if (diagnostics.ok()) Write(table, options.out, out, &diagnostics);
    return finish(kCompensateOk);
  }
  const auto commands = Commands(*inputs, arm, &diagnostics);
  if (!commands) return finish(kCompensateBadInput);
  Eigen::MatrixXd q(inputs->rows.num_rows(), inputs->model.robot.num_joints());
  int refused = 0;
  for (std::size_t row = 0; row < commands->size(); ++row) {
    const Command& command = (*commands)[row];
    q.row(static_cast<Eigen::Index>(row)) = command.q.transpose();
    if (command.refusal.empty()) continue;
    ++refused;
    messages << fmt::format("row {}: {}\n", row + 1, command.refusal);
  }
  const auto expected = Expected(options, *inputs, arm, q, &diagnostics);
  const std::string table =
      CommandsToCsv(inputs->model.robot, *commands, expected.value_or(Eigen::VectorXd()));
  if (diagnostics.ok()) Write(table, options.out, out, &diagnostics);
  return finish(refused > 0 ? kCompensateRefused : kCompensateOk);
}

}  // namespace dhcal
