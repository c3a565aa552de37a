#include "tools/compensate/wanted_poses.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/io/csv_text.h"
#include "core/kinematics/dh_chain.h"

namespace dhcal {
namespace {

SourceLocation AtRow(const Recording& rows, int row) {
  return {rows.file, rows.lines.empty() ? 0 : rows.lines[static_cast<std::size_t>(row)]};
}

Eigen::Isometry3d RecordedPose(const Recording& rows, int row) {
  const Eigen::Vector4d q = rows.quaternion.row(row);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  X.translation() = rows.p_WQ.row(row).transpose();
  return X;
}

bool Turns(const JointRow& joint) { return joint.type == JointType::kRevolute; }

void AddExpected(const Eigen::VectorXd& expected, std::size_t row, CsvText* csv) {
  if (expected.size() > 0) csv->Number(expected[static_cast<Eigen::Index>(row)] / kMillimetre);
}

}  // namespace

std::optional<std::vector<Eigen::Isometry3d>> WantedPoses(
    const Recording& rows,
    const std::vector<Eigen::Isometry3d>& bases,
    PoseFrame frame,
    Diagnostics* diagnostics) {
  if (rows.p_WQ.rows() == 0 || rows.quaternion.rows() == 0) {
    diagnostics->Error({rows.file},
                       "a wanted pose needs x_mm, y_mm, z_mm and an orientation (qw qx qy qz, "
                       "roll_deg pitch_deg yaw_deg or another form); add them, or give the "
                       "nominal robot's joint coordinates with --nominal");
    return std::nullopt;
  }
  std::vector<Eigen::Isometry3d> wanted;
  for (int row = 0; row < rows.num_rows(); ++row) {
    if (!rows.p_WQ.row(row).allFinite() || !rows.quaternion.row(row).allFinite()) {
      diagnostics->Error(AtRow(rows, row),
                         "the row has no whole pose; fill its position and orientation, or "
                         "remove it");
      return std::nullopt;
    }
    const Eigen::Isometry3d X = RecordedPose(rows, row);
    wanted.push_back(frame == PoseFrame::kWorld ? X : bases[static_cast<std::size_t>(row)] * X);
  }
  return wanted;
}

std::vector<Eigen::Isometry3d> NominalPoses(const ProblemSpec& nominal,
                                            const Recording& rows,
                                            const std::vector<Eigen::Isometry3d>& bases) {
  const DhChain chain(nominal.robot);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(chain.slots().size());
  std::vector<Eigen::Isometry3d> poses;
  for (int row = 0; row < rows.num_rows(); ++row) {
    const std::vector<Target>& targets = nominal.robot.targets;
    Eigen::Isometry3d X_TQ = nominal.robot.first_X_TQ();
    for (const Target& target : targets) {
      const bool named =
          !rows.target_idx.empty() &&
          rows.target_names[static_cast<std::size_t>(rows.target(row))] == target.name;
      if (named) X_TQ = target.X_TQ;
    }
    poses.push_back(bases[static_cast<std::size_t>(row)] *
                    chain.FlangePose(rows.q.row(row).transpose(), none) * X_TQ);
  }
  return poses;
}

std::optional<Seeds> SeedsOf(const Recording& rows,
                             const Eigen::VectorXd& first,
                             Diagnostics* diagnostics) {
  if (rows.q.allFinite()) return Seeds{rows.q, false};
  if (first.size() == rows.q.cols()) {
    return Seeds{first.transpose().replicate(rows.num_rows(), 1), true};
  }
  diagnostics->Error(
      {rows.file},
      fmt::format("nothing says on which branch the arm is: give joint coordinates near each pose "
                  "in columns q1_deg ... q{0}_deg, or near the first with --seed_deg (of {0} "
                  "numbers)",
                  rows.q.cols()));
  return std::nullopt;
}

std::string CommandsToCsv(const RobotModel& robot,
                          const std::vector<Command>& commands,
                          const Eigen::VectorXd& expected) {
  CsvText csv;
  csv.Label("row");
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint) {
    csv.Label(fmt::format("q{}_{}", joint + 1, Turns(robot.joints[joint]) ? "deg" : "mm"));
  }
  csv.Label("position_error_nm");
  csv.Label("rotation_error_nrad");
  if (expected.size() > 0) csv.Label("expected_error_mm");
  csv.Label("status");
  csv.EndRow();
  for (std::size_t row = 0; row < commands.size(); ++row) {
    const Command& command = commands[row];
    const bool refused = !command.refusal.empty();
    csv.Integer(static_cast<int>(row) + 1);
    for (std::size_t joint = 0; joint < robot.joints.size(); ++joint) {
      const double unit = Turns(robot.joints[joint]) ? kDegree : kMillimetre;
      if (refused) {
        csv.Blank();
      } else {
        csv.Number(command.q[static_cast<Eigen::Index>(joint)] / unit);
      }
    }
    constexpr double kNano = 1e-9;
    for (const double error : {command.position_error, command.rotation_error}) {
      if (refused) {
        csv.Blank();
      } else {
        csv.Number(error / kNano);
      }
    }
    if (refused && expected.size() > 0) csv.Blank();
    if (!refused) AddExpected(expected, row, &csv);
    csv.Label(refused ? command.refusal : "ok");
    csv.EndRow();
  }
  return csv.Take();
}

std::string PosesToCsv(const std::vector<Eigen::Isometry3d>& poses,
                       const Eigen::VectorXd& expected) {
  CsvText csv;
  for (const char* const name : {"row", "x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"}) {
    csv.Label(name);
  }
  if (expected.size() > 0) csv.Label("expected_error_mm");
  csv.EndRow();
  for (std::size_t row = 0; row < poses.size(); ++row) {
    csv.Integer(static_cast<int>(row) + 1);
    for (const double x : poses[row].translation()) csv.Number(x / kMillimetre);
    const Eigen::Quaterniond q(poses[row].linear());
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) csv.Number(part);
    AddExpected(expected, row, &csv);
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace dhcal
