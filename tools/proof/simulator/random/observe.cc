#include "tools/proof/simulator/random/observe.h"

#include "tools/proof/simulator/random/poses.h"

namespace dhcal::concealed {

using Eigen::Index;
using Eigen::Isometry3d;
using Eigen::Vector3d;

int CoordinatesPerRow(Kind kind) {
  return kind == Kind::kPose ? 6 : kind == Kind::kDistance ? 1 : 3;
}

Vector3d RotationVector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::VectorXd Observe(const RandomTrial& trial,
                        const std::vector<Isometry3d>& poses,
                        const std::vector<Isometry3d>& reference,
                        double length_offset) {
  const Settings& s = trial.settings;
  const int width = CoordinatesPerRow(s.kind);
  const std::vector<int> before = RowsBefore(trial.motion);
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(width * static_cast<Index>(poses.size()));
  std::vector<Vector3d> positions;
  for (const Isometry3d& pose : poses) positions.emplace_back(pose.translation());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Index at = width * static_cast<Index>(i);
    const Vector3d& p = positions[i];
    if (s.kind == Kind::kDistance) {
      const Vector3d& anchor = trial.anchors[static_cast<std::size_t>(trial.anchor[i])];
      seen[at] = (p - anchor).norm() + length_offset;
      continue;
    }
    seen.segment<3>(at) = p;
    if (s.kind == Kind::kAdjacent && !s.shared_pose) {
      seen.segment<3>(at) -= before[i] < 0 ? p : positions[static_cast<std::size_t>(before[i])];
    }
    if (s.kind == Kind::kPose) {
      seen.segment<3>(at + 3) =
          RotationVector(poses[i].linear() * reference[i].linear().transpose());
    }
  }
  return seen;
}

}  // namespace dhcal::concealed
