// The kinds of causes that random trials draw from.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_CAUSE_SOURCES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_CAUSE_SOURCES_H_

#include <functional>
#include <vector>

#include "core/base/rng.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// What causes are drawn for: joints count from 1.
struct Subject {
  explicit Subject(const RandomTrial& trial);

  const RandomTrial& trial;
  std::vector<int> turning, sliding;
  std::vector<double> range_of_torque;  // [N m], slides [N], of each joint over the poses
  std::vector<int> loaded;              // gravity's torque varies
  std::vector<int> beams;  // links that are long enough to bend, the column not among them

  int num_joints() const { return trial.built.num_joints(); }
  double duration() const { return trial.motion.time[trial.motion.num_poses() - 1]; }
  /// Usual compliance of a joint [rad/(N m)].
  double UsualCompliance(int joint) const;
  double RangeOfTorque(int joint) const;
};

using Causes = std::vector<Cause>;

struct CauseSource {
  double weight = 1;
  bool possible = true;
  std::function<Causes(const Subject&, double strength, Rng*)> draw;
};

/// Of the library: loads, joints, and what depends on the clock, the row or the run.
std::vector<CauseSource> SourcesOfLoads(const Subject& subject);
std::vector<CauseSource> SourcesOfJoints(const Subject& subject);
std::vector<CauseSource> SourcesInTime(const Subject& subject);
/// Of no library.
std::vector<CauseSource> SourcesOutside(const Subject& subject);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_CAUSE_SOURCES_H_
