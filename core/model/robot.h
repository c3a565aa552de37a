// A serial robot as plain data: its nominal Denavit-Hartenberg rows, base, tool and masses.
// Conventions (DH product, frames, units) are fixed in core/NOTATION.md.
#ifndef DHCAL_CORE_MODEL_ROBOT_H_
#define DHCAL_CORE_MODEL_ROBOT_H_

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/model/head.h"

namespace dhcal {

enum class DhConvention { kStandard, kModified };
enum class JointType { kRevolute, kPrismatic };

/// One DH row. A revolute joint adds sign * q to theta, a prismatic one to d.
struct JointRow {
  std::string name;
  JointType type = JointType::kRevolute;
  double theta = 0;  // [rad]
  double d = 0;      // [m]
  double a = 0;      // [m]
  double alpha = 0;  // [rad]
  double beta = 0;   // [rad] Hayati's angle; zero in a plain DH row
  double sign = 1;   // +1 or -1: the controller's sense of the joint against DH's
  /// Limits as the controller counts [rad or m]; infinite where the file gives none.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  SourceLocation where;  // in the problem file
};

/// Mass of one link, in the frame that its DH row ends in.
struct LinkMass {
  double mass = 0;                                 // [kg]
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();  // [m] link frame to centre of mass
};

/// A named reflector or marker on the tool, flange frame T to its frame Q.
struct Target {
  std::string name;
  Eigen::Isometry3d X_TQ = Eigen::Isometry3d::Identity();
};

/// A point that distances are read to.
struct Anchor {
  std::string name;
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  // [m]
};

/// A base pose registered for one run only.
struct RunFrame {
  std::string run;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
};

/// A placement of a straight edge, E: x along the rulings, z out of the flat face, y = 0 and x = 0
/// anywhere.
struct Edge {
  std::string name;
  std::optional<Eigen::Isometry3d> X_WE;  // absent = to be found from the readings
};

struct RobotModel {
  std::string name;
  SourceLocation where;  // in the problem file
  DhConvention convention = DhConvention::kStandard;
  std::vector<JointRow> joints;

  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // measurement frame W to base B
  bool base_per_run = false;
  std::vector<RunFrame> base_of_run;  // optional starts, when per run

  /// Readings along straight edges: each edge is a measurement frame of its own, and the base has
  /// a pose in each, X_EB = X_WE^-1 X_WB.
  bool base_per_edge = false;
  std::vector<Edge> edges;  // those that the file defines

  Eigen::Isometry3d X_TQ = Eigen::Isometry3d::Identity();  // flange T to measured point Q
  bool tool_per_run = false;
  std::vector<RunFrame> tool_of_run;
  std::vector<Target> targets;  // instead of X_TQ when not empty

  /// Around the robot, where distances are read: those of the measurement, for effects of the
  /// instrument.
  std::vector<Anchor> anchors;
  /// On its tool, where it reads along edges: that of the measurement, for the same effects.
  std::optional<HeadSpec> head;

  Eigen::Vector3d gravity_B = Eigen::Vector3d(0, 0, -9.80665);  // [m/s^2]
  std::vector<LinkMass> links;                                  // empty, or one per joint
  LinkMass payload;                                             // in the flange frame T

  /// Of the first target where there are targets.
  const Eigen::Isometry3d& first_X_TQ() const {
    return targets.empty() ? X_TQ : targets.front().X_TQ;
  }

  int num_joints() const { return static_cast<int>(joints.size()); }
  /// Index of the row whose twist and length lie between the axes of joint_idx and the next:
  /// standard rows twist after their joint, modified rows before it.
  std::size_t row_between(int joint_idx) const {
    const auto idx = static_cast<std::size_t>(joint_idx);
    return convention == DhConvention::kStandard ? idx : idx + 1;
  }
};

/// "joint 4 (shoulder_pan)", as the problem file calls it; "joint 2" where its name says no more.
std::string JointWords(const RobotModel& robot, int joint_from_1);

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_ROBOT_H_
