// What varies between random trials besides the causes: file, readings and poses.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_SETTINGS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_SETTINGS_H_

#include <string>

#include "core/base/rng.h"
#include "tools/proof/simulator/arm.h"

namespace dhcal::concealed {

enum class Kind { kPosition, kPose, kDistance, kAdjacent };
enum class Order { kRandom, kSorted, kStreamed, kGrid };
enum class Tail { kGaussian, kStudent, kMixed };
/// What the file says of a quantity.
enum class Said { kRight, kWrong, kNothing };
/// Whether the instrument was set up anew for each run, and whether the file says so.
enum class Setups { kOne, kStated, kForgotten };

const char* ToString(Kind kind);
const char* ToString(Order order);
const char* ToString(Tail tail);
const char* ToString(Said said);
const char* ToString(Setups setups);

struct Settings {
  std::string robot = "kr15";
  bool complete = true;  // estimate: complete, else [theta, alpha, a, d]
  Kind kind = Kind::kPosition;
  bool shared_pose = false;  // differences of readings that neighbours share
  bool far = false;          // the instrument stands metres away and looks elsewhere
  double noise = 0.03e-3, noise_rotation = 0.05e-3;  // [m], [rad] of one coordinate
  Said sigma = Said::kRight;
  double sigma_factor = 1;  // stated over true
  Said masses = Said::kRight;
  Tail tail = Tail::kGaussian;
  double outliers = 0;  // share of readings
  // Of the noise's variance, what goes on from a reading to the next, and how much of it.
  double wandering = 0, wandering_on = 0;
  Order order = Order::kRandom;
  int rows = 200, repeats = 1, targets = 1, runs = 1;
  bool repeats_share = false;  // repeats of a pose share its error
  int decimals = 4;            // of the joint angles [deg], slides [mm]
  Setups setups = Setups::kOne;
  bool test_rows = false, directions = false, clock = true, payload_varies = false;
};

Settings DrawSettings(Rng* rng);

/// The drawing that `settings.robot` names, seen from where the instrument stands, with targets.
Arm DrawArm(const Settings& settings, Rng* rng);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_RANDOM_SETTINGS_H_
