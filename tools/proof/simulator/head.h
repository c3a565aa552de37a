// A measuring head over placements of a straight edge, and what is wrong with it: surfaces, beams
// and rulings by their own laws.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_HEAD_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_HEAD_H_

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/motion.h"
#include "tools/proof/simulator/physics.h"

namespace dhcal::concealed {

/// All sensors look along the tool's z axis.
struct EdgeHead {
  Eigen::Vector3d camera = {0.02, 0, 0};  // [m] in the tool frame
  std::array<Eigen::Vector3d, 2> lasers = {Eigen::Vector3d(-0.03, 0.05, 0.01),
                                           Eigen::Vector3d(-0.03, -0.05, 0.01)};
  double pitch = 2e-3;                               // [m] between rulings
  double camera_noise = 20e-6, laser_noise = 10e-6;  // [m]
  double length = 0.5;                               // [m] of the edge
  std::vector<Eigen::Isometry3d> placements;         // x along the rulings, z out of the face
};

struct EdgeRuns {
  int placements = 0;
  int poses = 0;  // of each
  int tests = 0;  // of them, the last ones, never fitted
};

/// Sends the arm along placements of an edge within its reach, each a run of its own, with the tool
/// tilted by up to 25 deg and turned.
Motion AlongEdges(const Arm& arm, const EdgeRuns& runs, EdgeHead* head, Rng* rng);

/// Ruler, height 1, height 2 of every pose (poses x 3) [m], without noise.
Eigen::MatrixXd HeadNumbers(const EdgeHead& head,
                            const Arm& built,
                            const Physics& physics,
                            const Motion& motion);

/// Each sensor's column over its noise, times the camera's: all columns are as noisy as the camera.
Eigen::MatrixXd AlikeNoisy(const EdgeHead& head, Eigen::MatrixXd numbers);

/// d those numbers / d every geometric freedom: rows, tool with its turns, and each placement's
/// pose; 3 poses x freedoms.
Eigen::MatrixXd HeadSignatures(const EdgeHead& head,
                               const Arm& drawing,
                               const Arm& built,
                               const Motion& motion);

/// The lines of the problem file's `measurement`.
std::string HeadYaml(const EdgeHead& head, bool sigma_given);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_HEAD_H_
