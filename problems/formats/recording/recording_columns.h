// The columns that a recording may have (FORMATS.md, section 1): names, units and meaning.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_COLUMNS_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_COLUMNS_H_

#include <string>
#include <vector>

#include "core/model/robot.h"

namespace dhcal {

enum class RecordingField {
  kJoint,
  kPosition,
  kDisplacement,
  kQuaternion,
  // The orientation in other forms; each is converted to the quaternion.
  kRotationVector,
  kRpy,            // about the fixed axes x, y, z in this order: Rz(yaw) Ry(pitch) Rx(roll)
  kAbc,            // KUKA's: Rz(A) Ry(B) Rx(C)
  kEulerXyz,       // about the turning axes x, y, z in this order: Rx Ry Rz
  kMatrix,         // 3 x 3, row by row
  kMatrixLastRow,  // 0 0 0 1 of a homogeneous matrix
  kDistance,
  kSigma,
  kTime,
  kPayload,
  kTemperature,       // one for the whole robot
  kJointTemperature,  // one per joint
  kDirection,
  kSpeed,
  kTorque,
  kRun,
  kTarget,
  kAnchor,
  kSet,
  kHead,  // ruler, height1, height2 of the head over a straight edge
  kEdge,
};

/// One name that a column may have.
struct KnownColumn {
  std::string name;  // with its unit, "q3_deg"
  std::string stem;  // without, "q3"
  RecordingField field;
  int component = 0;  // joint or coordinate, from 0
  double to_si = 1;
};

/// The fields that hold an orientation.
const std::vector<RecordingField>& OrientationFields();

/// Every name that the recording of a robot with these joints may have.
std::vector<KnownColumn> KnownColumns(const std::vector<JointRow>& joints);

/// Why a name that is not known must be a mistake, such as a wrong unit or a joint too many; ""
/// when the column may be one of the user's own.
std::string MistakeInName(const std::string& name,
                          int num_joints,
                          const std::vector<KnownColumn>& known);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_COLUMNS_H_
