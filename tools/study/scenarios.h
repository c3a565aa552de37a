// Recordings with a known answer, drawn many times: what the diagnosis is measured with.
//
// They are made with this program's own kinematics and, for effects of the library, its own
// formulas: they measure the statistics (false alarms, power, naming, intervals), not the physics.
#ifndef DHCAL_TOOLS_STUDY_SCENARIOS_H_
#define DHCAL_TOOLS_STUDY_SCENARIOS_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/physics/context.h"

namespace dhcal {

struct Scenario {
  std::string name;
  std::string group;  // "null", "single", "several", "outside", "masses"
  bool ur10 = false;
  bool narrow = false;
  bool planar = false;  // joints 1, 4 and 6 stand still: all positions lie in one plane
  int runs = 1;         // of equal length; differences do not cross them
  std::string kind = "position";
  NoiseKind noise = NoiseKind::kIndependent;
  int poses = 100;
  double sigma = 0.03e-3;  // [m]
  bool sigma_known = true;
  double outliers = 0;               // share of rows with ten times the noise
  std::vector<EffectRequest> truth;  // with values
  // Physics that the library does not have: adds to a slot vector at a row.
  std::function<void(const PhysicsContext&, int row, Eigen::VectorXd* delta)> outside;
  std::string outside_slot;   // where that acts
  bool wrong_masses = false;  // the problem file's masses are off by 30 %, its payload by 2 kg
};

struct Draw {
  ProblemSpec spec;
  Recording recording;
};

/// An effect with its values, as a scenario's truth.
EffectRequest Request(const std::string& effect,
                      int joint,
                      std::map<std::string, double> values = {},
                      std::map<std::string, double> settings = {});

/// One draw: geometry errors (3 mrad mastering, 1 mrad, 0.3 mm), poses and noise from the seed.
Draw MakeDraw(const Scenario& scenario, std::uint64_t seed);

std::vector<Scenario> AllScenarios();

}  // namespace dhcal

#endif  // DHCAL_TOOLS_STUDY_SCENARIOS_H_
