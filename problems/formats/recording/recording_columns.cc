#include "problems/formats/recording/recording_columns.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {

namespace {

using Units = std::vector<std::pair<std::string, double>>;

const Units kNoUnit = {{"", 1.0}};
const Units kLength = {{"_mm", kMillimetre}, {"_m", 1.0}};
const Units kAngle = {{"_deg", kDegree}, {"_rad", 1.0}};
const Units kAngleSpeed = {{"_deg_s", kDegree}, {"_rad_s", 1.0}};
const Units kLengthSpeed = {{"_mm_s", kMillimetre}, {"_m_s", 1.0}};

void Add(const std::string& stem,
         const Units& units,
         RecordingField field,
         int component,
         std::vector<KnownColumn>* columns) {
  for (const auto& [suffix, to_si] : units) {
    columns->push_back({stem + suffix, stem, field, component, to_si});
  }
}

void AddJointColumns(const std::vector<JointRow>& joints, std::vector<KnownColumn>* columns) {
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) {
    const std::string number = std::to_string(i + 1);
    const bool turns = joints[i].type == JointType::kRevolute;
    const Units torque = {{turns ? "_Nm" : "_N", 1.0}};
    Add("q" + number, turns ? kAngle : kLength, RecordingField::kJoint, i, columns);
    Add("qd" + number, turns ? kAngleSpeed : kLengthSpeed, RecordingField::kSpeed, i, columns);
    Add("torque" + number, torque, RecordingField::kTorque, i, columns);
    Add("dir" + number, kNoUnit, RecordingField::kDirection, i, columns);
    Add("temperature" + number, {{"_C", 1.0}}, RecordingField::kJointTemperature, i, columns);
  }
}

void AddCoordinates(std::vector<KnownColumn>* columns) {
  const std::vector<std::string> axes = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    Add(axes[i], kLength, RecordingField::kPosition, i, columns);
    Add("d" + axes[i], kLength, RecordingField::kDisplacement, i, columns);
  }
  const std::vector<std::string> quaternion = {"qw", "qx", "qy", "qz"};
  for (int i = 0; i < 4; ++i) {
    Add(quaternion[i], kNoUnit, RecordingField::kQuaternion, i, columns);
  }
}

void AddAngles(const std::vector<std::string>& stems,
               RecordingField field,
               std::vector<KnownColumn>* columns) {
  for (int i = 0; i < static_cast<int>(stems.size()); ++i) {
    Add(stems[i], kAngle, field, i, columns);
  }
}

void AddOrientations(std::vector<KnownColumn>* columns) {
  AddAngles({"rotvec_x", "rotvec_y", "rotvec_z"}, RecordingField::kRotationVector, columns);
  AddAngles({"roll", "pitch", "yaw"}, RecordingField::kRpy, columns);
  AddAngles({"a", "b", "c"}, RecordingField::kAbc, columns);
  AddAngles({"euler_xyz_x", "euler_xyz_y", "euler_xyz_z"}, RecordingField::kEulerXyz, columns);
  for (int i = 0; i < 3; ++i) {
    const std::string row = "m" + std::to_string(i + 1);
    for (int j = 0; j < 3; ++j) {
      Add(row + std::to_string(j + 1), kNoUnit, RecordingField::kMatrix, 3 * i + j, columns);
    }
    Add(row + "4", kLength, RecordingField::kPosition, i, columns);
  }
  for (int j = 0; j < 4; ++j) {
    Add("m4" + std::to_string(j + 1), kNoUnit, RecordingField::kMatrixLastRow, j, columns);
  }
}

bool IsOrientation(RecordingField field) {
  const std::vector<RecordingField>& fields = OrientationFields();
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

/// "q12_deg" -> "q", "12", "_deg"; the number may be empty.
struct NameParts {
  std::string letters, number, ending;
};

NameParts SplitName(const std::string& name) {
  NameParts parts;
  std::size_t at = 0;
  while (at < name.size() && std::isalpha(static_cast<unsigned char>(name[at])) != 0) ++at;
  parts.letters = name.substr(0, at);
  const std::size_t digits = at;
  while (at < name.size() && std::isdigit(static_cast<unsigned char>(name[at])) != 0) ++at;
  parts.number = name.substr(digits, at - digits);
  parts.ending = name.substr(at);
  return parts;
}

/// Whether the ending of a name is a unit, right or wrong: then the column is one of ours with a
/// mistake and not somebody's own. No ending is a unit forgotten.
bool LooksLikeUnit(const std::string& ending) {
  static const std::vector<std::string> units = {
      "",   "_deg", "_rad", "_mrad", "_mm",    "_m",     "_cm",   "_um", "_in",
      "_s", "_ms",  "_us",  "_min",  "_kg",    "_g",     "_N",    "_Nm", "_Nmm",
      "_C", "_K",   "_F",   "_lb",   "_deg_s", "_rad_s", "_mm_s", "_m_s"};
  return std::find(units.begin(), units.end(), ending) != units.end();
}

}  // namespace

const std::vector<RecordingField>& OrientationFields() {
  static const std::vector<RecordingField> fields = {RecordingField::kQuaternion,
                                                     RecordingField::kRotationVector,
                                                     RecordingField::kRpy,
                                                     RecordingField::kAbc,
                                                     RecordingField::kEulerXyz,
                                                     RecordingField::kMatrix};
  return fields;
}

std::vector<KnownColumn> KnownColumns(const std::vector<JointRow>& joints) {
  std::vector<KnownColumn> columns;
  AddJointColumns(joints, &columns);
  AddCoordinates(&columns);
  AddOrientations(&columns);
  Add("distance", kLength, RecordingField::kDistance, 0, &columns);
  Add("sigma", kLength, RecordingField::kSigma, 0, &columns);
  Add("t", {{"_s", 1.0}}, RecordingField::kTime, 0, &columns);
  Add("payload", {{"_kg", 1.0}}, RecordingField::kPayload, 0, &columns);
  Add("temperature", {{"_C", 1.0}}, RecordingField::kTemperature, 0, &columns);
  Add("run", kNoUnit, RecordingField::kRun, 0, &columns);
  Add("target", kNoUnit, RecordingField::kTarget, 0, &columns);
  Add("anchor", kNoUnit, RecordingField::kAnchor, 0, &columns);
  Add("set", kNoUnit, RecordingField::kSet, 0, &columns);
  Add("edge", kNoUnit, RecordingField::kEdge, 0, &columns);
  Add("ruler", kLength, RecordingField::kHead, 0, &columns);
  Add("height1", kLength, RecordingField::kHead, 1, &columns);
  Add("height2", kLength, RecordingField::kHead, 2, &columns);
  return columns;
}

std::string MistakeInName(const std::string& name,
                          int num_joints,
                          const std::vector<KnownColumn>& known) {
  const NameParts parts = SplitName(name);
  if (!LooksLikeUnit(parts.ending)) return "";
  const std::string stem = parts.letters + parts.number;
  std::vector<std::string> expected;
  for (const KnownColumn& column : known) {
    // "a", "roll" and their like may well be somebody's own.
    const bool mistaken = column.stem == stem && !IsOrientation(column.field);
    if (mistaken) expected.push_back(column.name);
  }
  if (!expected.empty()) {
    return fmt::format(
        "column '{}' has a wrong unit or none; write {}", Printable(name), QuotedList(expected));
  }
  const std::vector<std::string> numbered = {"q", "qd", "torque", "dir", "temperature"};
  const bool is_numbered =
      std::find(numbered.begin(), numbered.end(), parts.letters) != numbered.end();
  if (!is_numbered || parts.number.empty()) return "";
  return fmt::format(
      "column '{}' belongs to joint {}, but the robot has {} joint{}; correct the "
      "recording or the robot's joints",
      Printable(name),
      parts.number,
      num_joints,
      num_joints == 1 ? "" : "s");
}

}  // namespace dhcal
