#include "problems/formats/urdf/urdf_corrected.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/dh_rows.h"
#include "core/math/rotation.h"
#include "core/model/joint_numbers.h"
#include "problems/formats/urdf/urdf_places.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Why rows cannot be those of the chain with corrections; empty when they can. Both modified.
std::string WhyOtherRows(const RobotModel& nominal, const RobotModel& calibrated) {
  constexpr double kLargest = 0.2;  // [rad] or [m]
  if (nominal.num_joints() != calibrated.num_joints()) {
    return fmt::format(
        "the chain has {} joints, the rows are {}", nominal.num_joints(), calibrated.num_joints());
  }
  for (std::size_t j = 0; j < nominal.joints.size(); ++j) {
    const JointRow& from = nominal.joints[j];
    const JointRow& to = calibrated.joints[j];
    if (from.type != to.type) return fmt::format("joint {} is of another type", j + 1);
    for (const JointNumber& number : kJointNumbers) {
      double change = to.*number.value - from.*number.value;
      if (number.unit == Unit::kRadian) change = std::remainder(change, 2 * kPi);
      if (std::abs(change) <= kLargest) continue;
      const bool angle = number.unit == Unit::kRadian;
      return fmt::format("{} of joint {} is {:.4g} {} from the chain's",
                         number.name,
                         j + 1,
                         std::abs(change) / (angle ? kDegree : kMillimetre),
                         angle ? "deg" : "mm");
    }
  }
  return "";
}

std::vector<Isometry3d> FramesAtZero(const RobotModel& robot) {
  return DhChain(robot).LinkFrames(Eigen::VectorXd::Zero(robot.num_joints()));
}

/// Bytes of the text to be replaced.
struct Edit {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// Without what rounding leaves of zero.
std::string Numbers(const Vector3d& v) {
  const auto clean = [](double number) { return std::abs(number) < 1e-15 ? 0 : number; };
  return fmt::format("{} {} {}", clean(v.x()), clean(v.y()), clean(v.z()));
}

/// A tag that is there is replaced; else one is put first into the joint, on a line of its own.
Edit EditOf(const XmlTag& tag,
            const XmlTag& joint,
            const std::string& name_and_attributes,
            const std::string& text) {
  if (tag.there()) {
    return {tag.begin, tag.end, "<" + name_and_attributes + (tag.closed(text) ? "/>" : ">")};
  }
  const std::size_t next = std::min(text.find_first_not_of(" \t\r\n", joint.end), text.size());
  return {joint.end,
          joint.end,
          text.substr(joint.end, next - joint.end) + "<" + name_and_attributes + "/>"};
}

bool Same(const Isometry3d& X, const Isometry3d& Y) {
  constexpr double kSameFrame = 1e-13;  // [m] and [rad]
  return (X.matrix() - Y.matrix()).cwiseAbs().maxCoeff() < kSameFrame;
}

/// Without the "-0.0000" of rounding.
Vector3d Rounded(const Vector3d& v, double step) {
  return v.unaryExpr([step](double number) { return std::round(number / step) * step + 0.0; });
}

std::string PoseWords(const Isometry3d& X) {
  const Vector3d p = Rounded(X.translation() / kMillimetre, 1e-4);
  const Vector3d rpy = Rounded(RpyFromRotation(X.linear()) / kDegree, 1e-5);
  return fmt::format("xyz {:.4f} {:.4f} {:.4f} mm, rpy {:.5f} {:.5f} {:.5f} deg",
                     p.x(),
                     p.y(),
                     p.z(),
                     rpy.x(),
                     rpy.y(),
                     rpy.z());
}

/// Where the measurement's frame and points are, seen from the URDF's links.
std::vector<std::string> EndWords(const UrdfChain& chain,
                                  const RobotModel& nominal,
                                  const RobotModel& calibrated) {
  std::vector<std::string> lines;
  const Isometry3d X_BA = nominal.X_WB.inverse();
  const auto base = [&](const std::string& of, const Isometry3d& X_WB) {
    const Isometry3d X_WA = X_WB * X_BA;
    if (Same(X_WA, Isometry3d::Identity())) return;
    lines.push_back(
        fmt::format("{} in the measurement frame{}: {}", chain.base_link, of, PoseWords(X_WA)));
  };
  if (calibrated.base_of_run.empty()) base("", calibrated.X_WB);
  for (const RunFrame& run : calibrated.base_of_run) base(" of run " + run.run, run.X);
  const Isometry3d X_ET = nominal.X_TQ.inverse();
  const auto point = [&](const std::string& of, const Isometry3d& X_TQ) {
    const Isometry3d X_EQ = X_ET * X_TQ;
    if (Same(X_EQ, Isometry3d::Identity())) return;
    lines.push_back(fmt::format("measured point{} in {}: {}", of, chain.tip_link, PoseWords(X_EQ)));
  };
  for (const Target& target : calibrated.targets) point(" " + target.name, target.X_TQ);
  for (const RunFrame& run : calibrated.tool_of_run) point(" of run " + run.run, run.X);
  if (calibrated.targets.empty() && calibrated.tool_of_run.empty()) point("", calibrated.X_TQ);
  return lines;
}

std::string Edited(std::string text, std::vector<Edit> edits) {
  std::stable_sort(
      edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  return text;
}

}  // namespace

std::string XmlComment(const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  // "--" ends a comment.
  for (std::size_t k = text.find("--"); k != std::string::npos; k = text.find("--", k)) {
    text.insert(k + 1, " ");
  }
  return "<!--\n" + text + "-->\n";
}

std::string XyzRpyAttributes(const Isometry3d& X) {
  return fmt::format(
      R"(xyz="{}" rpy="{}")", Numbers(X.translation()), Numbers(RpyFromRotation(X.linear())));
}

std::optional<std::vector<Isometry3d>> CorrectedOrigins(const UrdfTree& tree,
                                                        const UrdfChain& chain,
                                                        const RobotModel& calibrated,
                                                        const SourceLocation& where,
                                                        Diagnostics* diagnostics) {
  Diagnostics heard;  // its notes were told when the file was read
  const RobotModel nominal =
      InConvention(RobotOfUrdf(tree, chain, &heard), DhConvention::kModified);
  const RobotModel corrected = InConvention(calibrated, DhConvention::kModified);
  const std::string why = WhyOtherRows(nominal, corrected);
  if (!why.empty()) {
    diagnostics->Error(where,
                       fmt::format("the rows are not those of the chain from '{}' to '{}' of {}: "
                                   "{}; take the file that the rows were made from",
                                   chain.base_link,
                                   chain.tip_link,
                                   tree.file,
                                   why));
    return std::nullopt;
  }
  const std::vector<Isometry3d> X_BM = FramesAtZero(nominal);
  const std::vector<Isometry3d> X_BN = FramesAtZero(corrected);  // where the frames M really are
  std::vector<Isometry3d> origins;
  Isometry3d X_AC_before = Isometry3d::Identity(), X_AD_before = Isometry3d::Identity();
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    const Isometry3d& X_AC = chain.X_AC[j];
    const Isometry3d X_MC = (nominal.X_WB * X_BM[j + 1]).inverse() * X_AC;
    const Isometry3d X_AD = nominal.X_WB * X_BN[j + 1] * X_MC;  // where the link really is
    // The joint's parent link hangs on the link before.
    const Isometry3d X_AP = X_AC * tree.joints.at(chain.joints[j]).X_PC.inverse();
    const Isometry3d X_AP_corrected = X_AD_before * X_AC_before.inverse() * X_AP;
    origins.push_back(X_AP_corrected.inverse() * X_AD);
    X_AC_before = X_AC;
    X_AD_before = X_AD;
  }
  return origins;
}

std::optional<std::string> CorrectedUrdf(const UrdfTree& tree,
                                         const UrdfChain& chain,
                                         const RobotModel& calibrated,
                                         const std::vector<std::string>& remarks,
                                         Diagnostics* diagnostics) {
  const auto origins = CorrectedOrigins(tree, chain, calibrated, {tree.file}, diagnostics);
  const std::optional<UrdfPlaces> places = FindUrdfPlaces(tree.file, tree.text, diagnostics);
  if (!origins || !places) return std::nullopt;
  std::vector<Edit> edits;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    const UrdfJoint& joint = tree.joints.at(chain.joints[j]);
    const UrdfJointPlace& place = places->joints.at(joint.name);
    if (calibrated.joints[j].sign < 0) {
      edits.push_back(EditOf(place.axis,
                             place.joint,
                             fmt::format(R"(axis xyz="{}")", Numbers(-joint.axis_C)),
                             tree.text));
    }
    if (Same((*origins)[j], joint.X_PC)) continue;
    edits.push_back(
        EditOf(place.origin, place.joint, "origin " + XyzRpyAttributes((*origins)[j]), tree.text));
  }
  Diagnostics heard;
  const RobotModel nominal =
      InConvention(RobotOfUrdf(tree, chain, &heard), DhConvention::kModified);
  std::vector<std::string> lines = remarks;
  for (std::string& line :
       EndWords(chain, nominal, InConvention(calibrated, DhConvention::kModified))) {
    lines.push_back(std::move(line));
  }
  edits.push_back({places->robot, places->robot, XmlComment(lines)});
  return Edited(tree.text, std::move(edits));
}

}  // namespace dhcal
