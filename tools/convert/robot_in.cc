#include "tools/convert/robot_in.h"

#include <utility>

#include <yaml-cpp/yaml.h>

#include "core/base/text.h"
#include "core/io/text_file.h"
#include "core/kinematics/dh_rows.h"
#include "problems/formats/exchange/ros_kinematics.h"
#include "problems/formats/exchange/ur_calibration.h"
#include "problems/formats/problem/robot_file.h"
#include "problems/formats/urdf/urdf_tree.h"

namespace dhcal {
namespace {

bool IsUrdfName(const std::string& file) {
  const std::string name = InLowerCase(file);
  return EndsWith(name, ".urdf") || EndsWith(name, ".xml") || EndsWith(name, ".xacro");
}

/// Whether a YAML file has `kinematics` where a problem file has `robot`; false where it is no
/// YAML, which whoever reads it says.
bool IsRosKinematics(const std::string& file) {
  Diagnostics heard;
  const std::optional<std::string> text = ReadTextFile(file, &heard);
  if (!text) return false;
  try {
    const YAML::Node root = YAML::Load(*text);
    return root.IsMap() && root["kinematics"].IsDefined() && !root["robot"].IsDefined();
  } catch (const YAML::Exception&) {
    return false;
  }
}

std::optional<UrdfWithChain> ChainOf(std::optional<UrdfTree> tree,
                                     const std::string& base_link,
                                     const std::string& tip_link,
                                     Diagnostics* diagnostics) {
  if (!tree) return std::nullopt;
  // What is wrong with a link's name was written on the command line.
  std::optional<UrdfChain> chain =
      FindUrdfChain(*tree, {base_link, tip_link, {"--base_link"}, {"--tip_link"}}, diagnostics);
  if (!chain) return std::nullopt;
  return UrdfWithChain{std::move(*tree), std::move(*chain)};
}

bool ReadFromUrdf(const ConvertOptions& options, RobotIn* in, Diagnostics* diagnostics) {
  std::optional<UrdfWithChain> urdf = ChainOf(
      ReadUrdf(options.from, diagnostics), options.base_link, options.tip_link, diagnostics);
  if (!urdf) return false;
  in->robot = RobotOfUrdf(urdf->tree, urdf->chain, diagnostics);
  in->urdf = std::move(urdf);
  return true;
}

bool ReadFromProblem(const std::string& file,
                     const ConvertOptions& options,
                     RobotIn* in,
                     Diagnostics* diagnostics) {
  std::optional<RobotFile> read = ReadRobotFile(file, options.data_dir, diagnostics);
  if (!read) return false;
  in->robot = std::move(read->robot);
  in->effects = std::move(read->effects);
  if (!read->urdf) return true;
  in->urdf = ChainOf(ParseUrdf(read->urdf->file, read->urdf->text, diagnostics),
                     read->urdf->base_link,
                     read->urdf->tip_link,
                     diagnostics);
  return in->urdf.has_value();
}

bool ReadFromUrCalibration(const ConvertOptions& options, RobotIn* in, Diagnostics* diagnostics) {
  const std::optional<UrCalibration> calibration = ReadUrCalibration(options.from, diagnostics);
  if (options.nominal.empty()) {
    diagnostics->Error({options.from},
                       "holds differences from the rows of the data sheet; give those with "
                       "--nominal robot.yaml");
    return false;
  }
  if (!calibration || !ReadFromProblem(options.nominal, options, in, diagnostics)) return false;
  if (in->robot.convention != DhConvention::kStandard) {
    diagnostics->Error({options.nominal},
                       "has modified rows; a calibration.conf corrects standard ones");
    return false;
  }
  AddUrCalibration(*calibration, {options.from}, &in->robot, diagnostics);
  in->robot = WithNearNormals(in->robot);
  return diagnostics->ok();
}

bool ReadFromRos(const ConvertOptions& options, RobotIn* in, Diagnostics* diagnostics) {
  const std::optional<RosKinematics> kinematics = ReadRosKinematics(options.from, diagnostics);
  if (!kinematics) return false;
  in->robot = RobotOfRosKinematics(*kinematics);
  in->hash = kinematics->hash;
  return true;
}

bool ReadKind(const ConvertOptions& options, RobotIn* in, Diagnostics* diagnostics) {
  if (IsUrdfName(options.from)) return ReadFromUrdf(options, in, diagnostics);
  if (EndsWith(InLowerCase(options.from), ".conf")) {
    return ReadFromUrCalibration(options, in, diagnostics);
  }
  if (IsRosKinematics(options.from)) return ReadFromRos(options, in, diagnostics);
  return ReadFromProblem(options.from, options, in, diagnostics);
}

}  // namespace

std::optional<RobotIn> ReadAnyRobot(const ConvertOptions& options, Diagnostics* diagnostics) {
  RobotIn in;
  if (!ReadKind(options, &in, diagnostics)) return std::nullopt;
  if (!options.urdf.empty()) {
    in.urdf = ChainOf(
        ReadUrdf(options.urdf, diagnostics), options.base_link, options.tip_link, diagnostics);
    if (!in.urdf) return std::nullopt;
  }
  return in;
}

}  // namespace dhcal
