#include "tools/convert/robot_out.h"

#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/kinematics/dh_rows.h"
#include "problems/formats/exchange/ros_kinematics.h"
#include "problems/formats/problem/robot_file.h"
#include "problems/formats/urdf/urdf_corrected.h"
#include "problems/formats/urdf/urdf_new.h"

namespace dhcal {
namespace {

/// "robot", "urdf", "ros_kinematics", or "" after an error.
std::string KindOf(const ConvertOptions& options, Diagnostics* diagnostics) {
  const std::vector<std::string> kinds = {"robot", "urdf", "ros_kinematics"};
  if (!options.kind.empty()) {
    for (const std::string& kind : kinds) {
      if (kind == options.kind) return kind;
    }
    diagnostics->Error({"--kind"},
                       fmt::format("is '{}', but {} is expected", options.kind, QuotedList(kinds)));
    return "";
  }
  const std::string name = InLowerCase(options.to);
  if (EndsWith(name, ".urdf") || EndsWith(name, ".xml")) return "urdf";
  if (EndsWith(name, ".yaml") || EndsWith(name, ".yml")) return "robot";
  diagnostics->Error(
      {options.to},
      EndsWith(name, ".conf")
          ? "cannot be made: a controller takes a calibration.conf only with its own checksums. "
            "ROS takes --kind ros_kinematics"
          : "does not end in .yaml or .urdf; say what it shall be with --kind " +
                QuotedList(kinds));
  return "";
}

std::vector<std::string> About(const RobotIn& in, const ConvertOptions& options) {
  std::vector<std::string> lines = {
      "Made by dhcal_convert from " +
      Printable(std::filesystem::path(options.from).filename().string()) + "."};
  if (!in.effects.empty()) {
    lines.push_back(fmt::format("Not in this file, for it holds geometry alone: {}.",
                                fmt::join(in.effects, ", ")));
  }
  return lines;
}

std::string RobotText(const RobotIn& in, const ConvertOptions& options) {
  std::vector<std::string> about = About(in, options);
  about.emplace_back("With measurement and recording it is a problem file.");
  const RobotModel robot =
      options.convention.empty()
          ? in.robot
          : InConvention(in.robot,
                         options.convention == "modified" ? DhConvention::kModified
                                                          : DhConvention::kStandard);
  return RobotFileText(robot, std::filesystem::path(options.to).stem().string(), about);
}

std::optional<std::string> UrdfText(const RobotIn& in,
                                    const ConvertOptions& options,
                                    Diagnostics* diagnostics) {
  if (!in.urdf) return UrdfOfRobot(in.robot, About(in, options));
  return CorrectedUrdf(in.urdf->tree, in.urdf->chain, in.robot, About(in, options), diagnostics);
}

std::optional<std::string> RosText(const RobotIn& in,
                                   const ConvertOptions& options,
                                   Diagnostics* diagnostics) {
  RosKinematics kinematics;
  if (in.urdf) {
    const auto origins =
        CorrectedOrigins(in.urdf->tree, in.urdf->chain, in.robot, {options.from}, diagnostics);
    if (!origins) return std::nullopt;
    kinematics.origins = *origins;
  } else {
    kinematics.origins = OriginsOfRows(in.robot);
  }
  if (kinematics.origins.size() != 6) {
    diagnostics->Error({options.from},
                       fmt::format("has {} joints, but a kinematics_params_file is of the six of "
                                   "a UR robot",
                                   kinematics.origins.size()));
    return std::nullopt;
  }
  if (!in.hash.empty()) kinematics.hash = in.hash;
  if (!options.hash.empty()) kinematics.hash = options.hash;
  if (kinematics.hash == kUnknownHash) {
    diagnostics->Note({options.to},
                      "its hash is not the controller's, which ROS' driver says at its start; "
                      "--hash calib_... sets it");
  }
  std::string text;
  for (const std::string& line : About(in, options)) text += "# " + line + "\n";
  return text + RosKinematicsText(kinematics);
}

}  // namespace

std::optional<std::string> AnyRobotText(const RobotIn& in,
                                        const ConvertOptions& options,
                                        Diagnostics* diagnostics) {
  const std::string kind = KindOf(options, diagnostics);
  if (kind.empty()) return std::nullopt;
  if (!in.effects.empty()) {
    diagnostics->Note(
        {options.to},
        fmt::format("holds geometry alone; not in it: {}", fmt::join(in.effects, ", ")));
  }
  if (kind == "robot") return RobotText(in, options);
  return kind == "urdf" ? UrdfText(in, options, diagnostics) : RosText(in, options, diagnostics);
}

}  // namespace dhcal
