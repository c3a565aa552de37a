#include "tools/proof/simulator/scenarios.h"

#include <cmath>
#include <utility>

#include "core/base/units.h"
#include "tools/proof/simulator/arms.h"
#include "tools/proof/simulator/causes.h"

namespace dhcal::concealed {
namespace {

using Eigen::Vector3d;

constexpr int kPoses = 200;  // every fourth is never fitted
constexpr int kTestStride = 4;

void Take(Trial* trial, Motion motion, int group = 1) {
  trial->motion = std::move(motion);
  KeepForTest(kTestStride, group, &trial->motion);
}

void TakeWide(Trial* trial, Rng* rng) {
  Take(trial, RandomPoses(trial->drawing, trial->drawing.wide, kPoses, rng));
}

void TakeNarrow(Trial* trial, Rng* rng) {
  Take(trial, RandomPoses(trial->drawing, trial->drawing.narrow, kPoses, rng));
}

double TimeBefore(const Trial& trial, int row) {
  return 0.5 * (trial.motion.time[row - 1] + trial.motion.time[row]);
}

/// Of a KR 15: sizes of torques go with the arm.
double TorqueScale(const Trial& trial) {
  return trial.drawing.name == "kr15" ? 1 : trial.drawing.name == "ur10" ? 0.25 : 0.06;
}

// Nothing left out.

void Clean(Trial* trial, Rng* rng) { TakeWide(trial, rng); }

void CleanNarrow(Trial* trial, Rng* rng) { TakeNarrow(trial, rng); }

void CleanRuler(Trial* trial, Rng* rng) {
  Take(trial, Series(trial->drawing, 12, 20, rng), 20);
  trial->differences = true;
}

void CleanLongRuler(Trial* trial, Rng* rng) {
  Take(trial, Series(trial->drawing, 5000, 20, rng), 20);
  trial->differences = true;
}

void CleanButWild(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->sensor.heavy_tails = true;
  trial->sensor.wrong_share = 0.02;
  trial->sigma_given = false;
}

void CleanButSlow(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->sensor.correlation = 0.5;
  trial->sigma_given = false;
}

void CleanButUnsteady(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->joint_band = 2e-5;
  trial->sigma_given = false;
}

void WrongScale(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->sensor.scale = 50e-6;
  trial->scale_is_wrong = true;
}

void HayatiForgotten(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->built.links[1].beta = rng->Uniform(0, 1) < 0.5 ? -0.4e-3 : 0.4e-3;
  trial->estimate = "[theta, alpha, a, d, base, tool]";
}

void ToolLengthWrong(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->drawing.tool.translation().z() += 2e-3;
}

// One cause.

void Joint2Yields(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Yields(2, trial->drawing.main_compliance)};
}

void Joint3YieldsUnseen(Trial* trial, Rng* rng) {
  TakeNarrow(trial, rng);
  trial->causes = {Yields(3, 1.3 * trial->drawing.main_compliance)};
}

void BaseYieldsUnseen(Trial* trial, Rng* rng) {
  TakeNarrow(trial, rng);
  trial->causes = {BaseYields(trial->drawing.base_compliance)};
}

void Joint2YieldsPairs(Trial* trial, Rng* rng) {
  Take(trial, PayloadPairs(trial->drawing, kPoses / 2, 1.5 * trial->drawing.payload, rng), 2);
  trial->causes = {Yields(2, trial->drawing.main_compliance)};
}

void Gear1Errs(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {GearErrs(1, 1, 1e-4, rng->Uniform(-kPi, kPi))};
}

void Gear1ErrsNarrow(Trial* trial, Rng* rng) {
  TakeNarrow(trial, rng);
  trial->causes = {GearErrs(1, 1, 1e-4, rng->Uniform(-kPi, kPi))};
}

void MeshErrs(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {GearErrs(3, 125, 0.7e-4, rng->Uniform(-kPi, kPi))};
}

void UnlistedOrder(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {GearErrs(2, 37, 0.7e-4, rng->Uniform(-kPi, kPi))};
}

void WristRatioWrong(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Coupled(5, 4, 2e-4)};
}

void ToolSlipsLate(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  const int at = kPoses * 6 / 10;
  const double angle = rng->Uniform(-kPi, kPi);
  trial->causes = {ToolSlips(
      at, TimeBefore(*trial, at), 0.1e-3 * Vector3d(std::cos(angle), 0.3, std::sin(angle)))};
}

void Joint3Remastered(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  const int at = kPoses / 2;
  trial->causes = {JointSlips(3, at, TimeBefore(*trial, at), 2e-4)};
}

void PayloadChanges(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->motion.payload_varies = true;
  for (int k = kPoses / 2; k < kPoses; ++k)
    trial->motion.payload[k] += 0.5 * trial->drawing.payload;
  trial->causes = {Yields(3, 1.3 * trial->drawing.main_compliance)};
}

void ReadLate(Trial* trial, Rng* rng) {
  Take(trial, Passes(trial->drawing, kPoses, rng));
  trial->causes = {Late(1e-3)};
}

void Joint5YieldsFaintly(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Yields(5, trial->drawing.wrist_compliance)};
  // Shares of the amplitude that is found in 90 % of recordings (non-centrality 27).
  constexpr double kLadder[] = {0.3, 0.6, 1, 2};
  const double share = kLadder[(trial->seed / 3) % 4];
  trial->wanted_lambda = 27 * share * share;
}

void MassesWrong(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Yields(2, trial->drawing.main_compliance)};
  // What the arm weighs is as drawn; what the file says is not.
  for (DrawnLink& link : trial->drawing.links) link.mass *= rng->Uniform(0.7, 1.3);
  trial->drawing.payload -= 0.2 * trial->drawing.payload;
  // With wrong masses no compliance is right.
  trial->causes[0].values.clear();
}

void YieldsSoftlyAtRest(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {
      YieldsSoftly(2, 1.5 * trial->drawing.main_compliance, 150 * TorqueScale(*trial))};
}

void FrictionWindsUp(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {WindsUp(4, 1.5e-4)};
}

// Several.

void TwoPlays(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Plays(4, 3e-4), PlaysUnderLoad(2, 1.4e-4, 20 * TorqueScale(*trial))};
}

void WarmsUp(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {FirstLinkGrows(1.2e-4, 2520), SecondLinkGrows(1.2e-4, 900)};
}

void WarmsUpSorted(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  SortByFirstJoint(&trial->motion);
  trial->causes = {FirstLinkGrows(1.2e-4, 2520), SecondLinkGrows(1.2e-4, 900)};
}

void ThreeAtOnce(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Yields(2, 0.67 * trial->drawing.main_compliance),
                   Plays(4, 3e-4),
                   FirstLinkGrows(0.6e-4, 2520)};
}

void YieldsWithBalancer(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  // A spring that carries about 40 % of the gravity torque.
  trial->causes = {Yields(2, trial->drawing.main_compliance), Balanced(4e3 * TorqueScale(*trial))};
  // The spring hides part of the gravity torque: the compliance alone is not compared.
  trial->causes[0].values.clear();
}

// Outside the library.

void ToothBroken(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  const double at = trial->drawing.middle[2] + 0.4 * trial->drawing.wide[2] * rng->Uniform(-1, 1);
  trial->causes = {ToothDamaged(3, at, 20 * kDegree, 0.4e-3)};
}

void CableDrags(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {CablePulls(5, 4, 6, 0.15e-3)};
}

void Kink(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  trial->causes = {Kinked(2, trial->drawing.middle[1] + 0.2, 0.5e-3)};
}

void Sways(Trial* trial, Rng* rng) {
  TakeWide(trial, rng);
  const double duration = trial->motion.time[kPoses - 1];
  trial->causes = {FloorSways(Vector3d(0.04e-3, 0.02e-3, 0.03e-3), duration / 7)};
}

/// Of positions and their differences.
const std::vector<Scenario>& PointScenarios() {
  constexpr bool kQuick = true;
  static const std::vector<Scenario> scenarios = {
      {"D1", "nothing left out, wide", Group::kNull, kQuick, 1000, Clean},
      {"D1N", "nothing left out, narrow", Group::kNull, false, 1000, CleanNarrow},
      {"D2",
       "nothing left out, differences of shared readings",
       Group::kNull,
       kQuick,
       1000,
       CleanRuler},
      {"D2L", "the same, 100,000 poses", Group::kNull, false, 1, CleanLongRuler},
      {"D3",
       "nothing; Student-t noise, 2 % wrong graduations",
       Group::kNull,
       kQuick,
       1000,
       CleanButWild},
      {"D3C", "nothing; serially correlated noise (0.5)", Group::kNull, false, 1000, CleanButSlow},
      {"D3B", "nothing; in-position band of 20 urad", Group::kNull, false, 1000, CleanButUnsteady},
      {"D15", "instrument's scale wrong by 50 ppm", Group::kNull, false, 1000, WrongScale},
      {"D19A", "Hayati's angle forgotten in the file", Group::kNull, kQuick, 1000, HayatiForgotten},
      {"D19B", "tool length in the file wrong by 2 mm", Group::kNull, false, 1000, ToolLengthWrong},
      {"D4", "joint 2 yields, wide", Group::kSingle, kQuick, 1000, Joint2Yields},
      {"D5", "joint 3 yields, narrow", Group::kConcealed, kQuick, 1000, Joint3YieldsUnseen},
      {"D6", "base yields, narrow", Group::kConcealed, false, 1000, BaseYieldsUnseen},
      {"D7", "joint 2 yields, payload pairs", Group::kSingle, false, 1000, Joint2YieldsPairs},
      {"D8", "gear of joint 1 errs once per turn, wide", Group::kSingle, false, 1000, Gear1Errs},
      {"D8N",
       "gear of joint 1 errs once per turn, narrow",
       Group::kConcealed,
       false,
       1000,
       Gear1ErrsNarrow},
      {"D9", "gear of joint 3 errs 125 times per turn", Group::kSingle, kQuick, 1000, MeshErrs},
      {"D10", "play in joint 4, loaded play in joint 2", Group::kSeveral, kQuick, 1000, TwoPlays},
      {"D10F", "friction winds up joint 4", Group::kSingle, false, 1000, FrictionWindsUp},
      {"D11", "joint 4 turns joint 5 (wrong ratio)", Group::kSingle, false, 1000, WristRatioWrong},
      {"D12", "column and link 2 warm up", Group::kSeveral, false, 1000, WarmsUp},
      {"D12S", "the same, poses sorted by joint 1", Group::kSeveral, false, 1000, WarmsUpSorted},
      {"D13", "tool slips at 60 % of the run", Group::kSingle, kQuick, 1000, ToolSlipsLate},
      {"D14A", "joint 3 remastered half way", Group::kSingle, false, 1000, Joint3Remastered},
      {"D14B",
       "payload changes half way, joint 3 yields",
       Group::kSingle,
       false,
       1000,
       PayloadChanges},
      {"D17", "positions read 1 ms late, two speeds", Group::kSingle, false, 1000, ReadLate},
      {"D18A", "damaged tooth of joint 3", Group::kOutside, kQuick, 1000, ToothBroken},
      {"D18B", "cable pulls joint 5", Group::kOutside, false, 1000, CableDrags},
      {"D18C", "unlisted order 37 at joint 2", Group::kSingle, false, 1000, UnlistedOrder},
      {"D18D", "kink of joint 2", Group::kOutside, false, 1000, Kink},
      {"D18E", "floor sways seven times", Group::kOutside, kQuick, 1000, Sways},
      {"D20",
       "joint 2 yields, play in 4, link 1 warms up",
       Group::kSeveral,
       kQuick,
       1000,
       ThreeAtOnce},
      {"D21",
       "joint 5 yields at 0.3 to 2 detection limits",
       Group::kConcealed,
       false,
       1000,
       Joint5YieldsFaintly},
      {"D22", "joint 2 yields, masses wrong by 30 %", Group::kSingle, false, 1000, MassesWrong},
      {"D23", "joint 2 yields softly around rest", Group::kSingle, false, 1000, YieldsSoftlyAtRest},
      {"D23B",
       "joint 2 yields against a balancer",
       Group::kSeveral,
       false,
       1000,
       YieldsWithBalancer}};
  return scenarios;
}

}  // namespace

const std::vector<Scenario>& AllScenarios() {
  static const std::vector<Scenario> all = [] {
    std::vector<Scenario> both = PointScenarios();
    both.insert(both.end(), HeadScenarios().begin(), HeadScenarios().end());
    return both;
  }();
  return all;
}

Trial MakeTrial(const Scenario& scenario, int seed) {
  // Scenarios share no draw: a rare noise must not count as often as there are scenarios.
  std::uint64_t scenario_seed = 17;
  for (const char letter : scenario.name) {
    scenario_seed = scenario_seed * 131 + static_cast<unsigned char>(letter);
  }
  Rng rng(scenario_seed * 1000003 + static_cast<std::uint64_t>(seed));
  Trial trial;
  trial.scenario = scenario.name;
  trial.story = scenario.story;
  trial.group = scenario.group;
  trial.seed = static_cast<std::uint64_t>(seed);
  trial.noise_seed = scenario_seed * 1000003 + static_cast<std::uint64_t>(seed) + 500009;
  trial.drawing = seed % 3 == 1 ? KukaKr15() : seed % 3 == 2 ? UniversalUr10() : SmallArm();
  trial.built = AsBuilt(trial.drawing, &rng);
  trial.sensor.noise = trial.drawing.noise;
  scenario.set_up(&trial, &rng);
  WeighCauses(&trial);
  return trial;
}

}  // namespace dhcal::concealed
