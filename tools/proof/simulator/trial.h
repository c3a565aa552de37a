// One concealed experiment: an arm as drawn and as built, physics that the file does not mention,
// a motion and an instrument.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_TRIAL_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_TRIAL_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/cause.h"
#include "tools/proof/simulator/head.h"
#include "tools/proof/simulator/motion.h"
#include "tools/proof/simulator/physics.h"
#include "tools/proof/simulator/sensor.h"
#include "tools/proof/simulator/visibility.h"

namespace dhcal::concealed {

enum class Group { kNull, kSingle, kSeveral, kConcealed, kOutside };

const char* ToString(Group group);

struct Trial {
  std::string scenario;  // "D4"
  std::string story;     // one line
  Group group = Group::kSingle;
  std::uint64_t seed = 1, noise_seed = 1;
  Arm drawing;  // what the problem file says
  Arm built;
  Motion motion;
  Sensor sensor;
  std::optional<EdgeHead> head;  // reads along edges instead of positions
  double ruler_scale = 0;        // of its ruler, beside all causes
  bool differences = false;      // shared-pose differences instead of positions
  bool sigma_given = true;       // the file states the noise
  std::string estimate = "[complete]";
  std::vector<Cause> causes;
  double joint_band = 0;        // [rad] in-position band of the controller
  double wanted_lambda = 0;     // > 0: the only cause is scaled to this non-centrality
  bool scale_is_wrong = false;  // of the instrument, which no such recording shows
};

/// All physics of the trial, and all but one cause.
Physics AllPhysics(const Trial& trial);
Physics PhysicsWithout(const Trial& trial, std::size_t cause);

/// Fills in the causes' visibility, scales to `wanted_lambda`.
void WeighCauses(Trial* trial);

/// What is wrong elsewhere (poses 120 deg about the middle of the recorded range) when the geometry
/// takes what it can of all causes.
Elsewhere TrueErrorElsewhere(const Trial& trial);

/// Readings of all poses (poses x 3) [m].
Eigen::MatrixXd Readings(const Trial& trial);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_TRIAL_H_
