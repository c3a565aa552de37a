// Where the arm was sent, in order, and under what circumstances.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_MOTION_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_MOTION_H_

#include <vector>

#include <Eigen/Core>

#include "core/base/rng.h"
#include "tools/proof/simulator/arm.h"

namespace dhcal::concealed {

struct Motion {
  Eigen::MatrixXd q;        // [rad], slides [m], as the controller reports it; poses x joints
  Eigen::MatrixXd speed;    // [rad/s] or [m/s]; 0 rows = standing still
  Eigen::VectorXd time;     // [s]
  Eigen::VectorXd payload;  // [kg]
  bool payload_varies = false;
  std::vector<int> run;     // number of the run of each pose
  std::vector<int> target;  // number of the target of each pose, from 0; empty = the tool
  std::vector<bool> test;   // never fitted

  int num_poses() const { return static_cast<int>(q.rows()); }
};

/// Independent poses, uniform within the half ranges about the arm's middle, one every 40 s.
Motion RandomPoses(const Arm& arm, const Eigen::VectorXd& half_range, int poses, Rng* rng);

/// Series of `length` poses in small steps (the ruler's way); each series is a run.
Motion Series(const Arm& arm, int series, int length, Rng* rng);

/// Passes with joint speeds: rows are taken on the way, at two speeds.
Motion Passes(const Arm& arm, int poses, Rng* rng);

/// Each pose twice, without payload and with `payload`.
Motion PayloadPairs(const Arm& arm, int pairs, double payload, Rng* rng);

/// Poses sorted by the first joint: time and place go together.
void SortByFirstJoint(Motion* motion);

/// Every `stride`th pose is kept for testing; with pairs or series, whole groups of `group`.
void KeepForTest(int stride, int group, Motion* motion);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_MOTION_H_
