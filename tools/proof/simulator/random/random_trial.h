// A trial of which a seed draws everything: robot, file, readings, poses, causes and their sizes.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_TRIAL_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_TRIAL_H_

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/rng.h"
#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/cause.h"
#include "tools/proof/simulator/motion.h"
#include "tools/proof/simulator/physics.h"
#include "tools/proof/simulator/random/settings.h"

namespace dhcal::concealed {

/// A quantity that somebody recorded beside the readings, and that the program does not know.
struct RecordedColumn {
  std::string name;
  Eigen::VectorXd course;  // of zero mean and unit deviation, as the arm may feel it
  Eigen::VectorXd read;    // as it stands in the file, in a unit of its own
  int decimals = 3;        // of these
};

struct RandomTrial {
  std::uint64_t seed = 1;
  Settings settings;
  Arm drawing;  // what the file says, masses besides
  Arm stated;   // the drawing with the masses that the file says
  Arm built;
  Motion motion;
  std::vector<Eigen::Vector3d> anchors;  // [m] in the measurement frame, for distances
  std::vector<int> anchor;               // of each row, from 0
  std::vector<Move> setups;              // of runs, where the file states them
  std::vector<RecordedColumn> columns;   // some drive nothing
  std::vector<Cause> causes;
  std::vector<std::string> geometry;  // names of geometry that is off and that the file holds fixed
};

RandomTrial MakeRandomTrial(int seed);

/// What holds besides the causes, all physics, and all but one cause.
Physics StatedPhysics(const RandomTrial& trial);
Physics AllPhysics(const RandomTrial& trial);
Physics PhysicsWithout(const RandomTrial& trial, std::size_t cause);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_RANDOM_TRIAL_H_
