#include "tools/proof/simulator/random/observe.h"

#include "tools/proof/simulator/random/poses.h"
#include "tools/proof/simulator/truth.h"

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

double DistanceRead(const RandomTrial& trial,
                    std::size_t row,
                    const Vector3d& p,
                    const Instrument& instrument) {
  const Vector3d& anchor = trial.anchors[static_cast<std::size_t>(trial.anchor[row])];
  const double scale = ScaleOf(instrument, trial.motion.time[static_cast<Index>(row)]);
  return scale * (p - anchor).norm() + instrument.length_offset;
}

Eigen::VectorXd Observe(const RandomTrial& trial,
                        const std::vector<Isometry3d>& poses,
                        const std::vector<Isometry3d>& reference,
                        const Instrument& instrument) {
  const Settings& s = trial.settings;
  const int width = CoordinatesPerRow(s.kind);
  const std::vector<int> before = RowsBefore(trial.motion);
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(width * static_cast<Index>(poses.size()));
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double scale = ScaleOf(instrument, trial.motion.time[static_cast<Index>(i)]);
    positions.emplace_back(scale * poses[i].translation());
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Index at = width * static_cast<Index>(i);
    const Vector3d& p = positions[i];
    if (s.kind == Kind::kDistance) {
      seen[at] = DistanceRead(trial, i, poses[i].translation(), instrument);
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
