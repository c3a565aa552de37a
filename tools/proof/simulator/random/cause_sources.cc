#include "tools/proof/simulator/random/cause_sources.h"

#include "tools/proof/simulator/statics.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kLoadedTorque = 0.5;  // [N m] of variation that loads a joint
constexpr double kShortestBeam = 0.2;  // [m] what is shorter does not bend

}  // namespace

Subject::Subject(const RandomTrial& of) : trial(of) {
  const int n = trial.built.num_joints();
  const ScrewArm screws(trial.drawing);
  const Motion& motion = trial.motion;
  Eigen::MatrixXd torques(motion.num_poses(), n);
  for (Index row = 0; row < torques.rows(); ++row) {
    torques.row(row) =
        RigidTorques(trial.drawing, screws, motion.q.row(row).transpose(), motion.payload[row]);
  }
  for (int joint = 1; joint <= n; ++joint) {
    const bool slides = trial.drawing.links[static_cast<std::size_t>(joint) - 1].slides;
    (slides ? sliding : turning).push_back(joint);
    const auto torque = torques.col(joint - 1);
    range_of_torque.push_back(torque.maxCoeff() - torque.minCoeff());
    if (!slides && range_of_torque.back() > kLoadedTorque) loaded.push_back(joint);
  }
  for (int link = 2; link < n; ++link) {
    const Vector3d beam = screws.end(link - 1).translation() - screws.start(link - 1).translation();
    if (beam.norm() > kShortestBeam) beams.push_back(link);
  }
}

double Subject::UsualCompliance(int joint) const {
  constexpr int kWrist = 3;
  const bool main = joint <= num_joints() - kWrist;
  return main ? trial.drawing.main_compliance : trial.drawing.wrist_compliance;
}

double Subject::RangeOfTorque(int joint) const {
  return range_of_torque[static_cast<std::size_t>(joint) - 1];
}

}  // namespace dhcal::concealed
