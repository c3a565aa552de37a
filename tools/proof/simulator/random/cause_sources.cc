#include "tools/proof/simulator/random/cause_sources.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/draw.h"
#include "tools/proof/simulator/statics.h"

namespace dhcal::concealed {
namespace {

using Causes = std::vector<Cause>;
using Eigen::Index;
using Eigen::Vector3d;

constexpr double kLoadedTorque = 0.5;  // [N m] of variation that loads a joint
constexpr double kShortestBeam = 0.2;  // [m] what is shorter does not bend

double Phase(Rng* rng) { return rng->Uniform(-kPi, kPi); }
double Sign(Rng* rng) { return Chance(0.5, rng) ? 1 : -1; }

int Another(const std::vector<int>& joints, int than, Rng* rng) {
  int joint = than;
  while (joint == than) joint = DrawFrom(joints, rng);
  return joint;
}

/// Low orders of a gear are smooth curves, which its other names imitate over a limited range.
Cause Gear(int joint, double order, double amplitude, Rng* rng) {
  Cause cause = GearErrs(joint, order, amplitude, Phase(rng));
  cause.also = {"transmission_error"};
  constexpr double kSmooth = 2.5;
  if (order < kSmooth) cause.also.insert(cause.also.end(), {"joint_gain", "gravity_balancer"});
  return cause;
}

/// The first row after a moment that is drawn, and that moment.
int RowOfStep(const Subject& of, Rng* rng, double* time) {
  const auto poses = static_cast<double>(of.trial.motion.num_poses());
  const int row = static_cast<int>(rng->Uniform(0.15, 0.85) * poses);
  *time = 0.5 * (of.trial.motion.time[row - 1] + of.trial.motion.time[row]);
  return row;
}

/// A turn about the first axis is one of the base; of a single target on the last axis, a shift of
/// the tool.
void SayWhatStepsAreSame(const Subject& of, Cause* cause) {
  if (cause->joint == 1) cause->same.emplace_back("base_step", 0);
  if (cause->joint == of.num_joints()) cause->same.emplace_back("tool_step", 0);
}

Move RandomMove(double shift, double turn, Rng* rng) {
  return {shift * DrawDirection(rng), turn * DrawDirection(rng)};
}

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

std::vector<CauseSource> SourcesOfLoads(const Subject& subject) {
  const bool loaded = !subject.loaded.empty();
  // Joint 2 carries the spring; the one that carries no load has no use for it.
  const bool lifts =
      std::find(subject.loaded.begin(), subject.loaded.end(), 2) != subject.loaded.end();
  return {{4,
           loaded,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             return Causes{Yields(joint, strength * of.UsualCompliance(joint))};
           }},
          {1,
           loaded,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             const double soft = of.RangeOfTorque(joint) * rng->Uniform(0.05, 0.3);
             return Causes{YieldsSoftly(joint, strength * of.UsualCompliance(joint), soft)};
           }},
          {1,
           lifts,
           [](const Subject& of, double strength, Rng* rng) {
             // A spring that carries some tens of per cent of gravity's torque of a KR 15.
             const double stiffness = 4e3 * of.trial.drawing.links[0].mass / 60;
             Cause spring = Balanced(stiffness * rng->Uniform(0.5, 1.5));
             spring.also.emplace_back("transmission_error");
             return Causes{Yields(2, strength * of.UsualCompliance(2)), spring};
           }},
          {1,
           loaded && !subject.beams.empty(),
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{LinkBends(DrawFrom(of.beams, rng), strength * 1e-6)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* /*rng*/) {
             return Causes{BaseYields(strength * of.trial.drawing.base_compliance)};
           }},
          {1, loaded, [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.loaded, rng);
             // As of a KR 15's second joint: near zero torque the approach decides.
             const double preload = 0.015 * of.RangeOfTorque(joint);
             return Causes{PlaysUnderLoad(joint, strength * 1e-4, preload)};
           }}};
}

std::vector<CauseSource> SourcesOfJoints(const Subject& subject) {
  return {{2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const double order = 1.0 + DrawInt(8, rng);
             return Causes{Gear(DrawFrom(of.turning, rng), order, strength * 1e-4, rng)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const double order = rng->Uniform(1, 12);  // between integers, of a stage inside
             return Causes{Gear(DrawFrom(of.turning, rng), order, strength * 1e-4, rng)};
           }},
          {1,
           subject.trial.settings.order == Order::kRandom ||
               subject.trial.settings.order == Order::kSorted,
           [](const Subject& of, double strength, Rng* rng) {
             constexpr double kMost = 5;
             const double order = std::round(10 * rng->Uniform(15, 150)) / 10;
             return Causes{
                 Gear(DrawFrom(of.turning, rng), order, std::min(strength, kMost) * 0.7e-4, rng)};
           }},
          {2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Plays(DrawFrom(of.turning, rng), strength * 1e-4)};
           }},
          {0.3,
           !subject.sliding.empty(),
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Plays(DrawFrom(of.sliding, rng), strength * 0.05e-3)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{WindsUp(DrawFrom(of.turning, rng), strength * 0.5e-4)};
           }},
          {2,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             const int joint = DrawFrom(of.turning, rng);
             const int driver = Another(of.turning, joint, rng);
             return Causes{Coupled(joint, driver, Sign(rng) * strength * 2e-4)};
           }},
          {1,
           true,
           [](const Subject& of, double strength, Rng* rng) {
             return Causes{Gains(DrawFrom(of.turning, rng), Sign(rng) * strength * 1e-4)};
           }},
          {1, true, [](const Subject& of, double strength, Rng* rng) {
             return Causes{Wobbles(DrawFrom(of.turning, rng), strength * 3e-5, Phase(rng))};
           }}};
}

std::vector<CauseSource> SourcesInTime(const Subject& subject) {
  const Settings& s = subject.trial.settings;
  // A drift begins anew with every run in the files, and differences hardly see it.
  const bool warms = s.runs == 1;
  return {
      {1.5,
       warms,
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.08, 0.6);
         return Causes{BaseDrifts(strength * 1.5e-4 * DrawDirection(rng), lag)};
       }},
      {1,
       warms,
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.08, 0.6);
         return Causes{JointDrifts(DrawFrom(of.turning, rng), Sign(rng) * strength * 1e-4, lag)};
       }},
      {1,
       warms && subject.trial.drawing.name != "scara",
       [](const Subject& of, double strength, Rng* rng) {
         const double lag = of.duration() * rng->Uniform(0.1, 0.5);
         return Causes{Chance(0.5, rng) ? FirstLinkGrows(strength * 1e-4, lag)
                                        : SecondLinkGrows(strength * 1e-4, lag)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         return Causes{ToolSlips(row, time, strength * 1e-4 * DrawDirection(rng))};
       }},
      {1.5,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         Cause cause =
             JointSlips(DrawFrom(of.turning, rng), row, time, Sign(rng) * strength * 1e-4);
         SayWhatStepsAreSame(of, &cause);
         return Causes{cause};
       }},
      {1,
       s.kind != Kind::kAdjacent,
       [](const Subject& of, double strength, Rng* rng) {
         double time = 0;
         const int row = RowOfStep(of, rng, &time);
         return Causes{BaseSteps(row, time, RandomMove(strength * 1e-4, strength * 0.5e-4, rng))};
       }},
      {1,
       s.order == Order::kStreamed,
       [](const Subject& /*of*/, double strength, Rng* rng) {
         return Causes{Late(Sign(rng) * strength * 0.3e-3)};
       }},
      {0.7,
       // Repeats of a pose stand still: the arm settles between them.
       s.order == Order::kRandom && s.repeats == 1,
       [](const Subject& /*of*/, double strength, Rng* /*rng*/) {
         return Causes{NotSettled(strength * 0.5e-4)};
       }},
      {3, s.kind == Kind::kDistance, [](const Subject& of, double strength, Rng* /*rng*/) {
         return Causes{ReadsLong(strength * 1e-4, static_cast<int>(of.trial.anchors.size()))};
       }}};
}

std::vector<CauseSource> SourcesOutside(const Subject& /*subject*/) {
  return {
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         const int joint = DrawFrom(of.turning, rng);
         const double at = of.trial.drawing.middle[joint - 1] +
                           0.5 * of.trial.drawing.wide[joint - 1] * rng->Uniform(-1, 1);
         return Causes{ToothDamaged(joint, at, rng->Uniform(15, 40) * kDegree, strength * 1e-4)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         const int joint = DrawFrom(of.turning, rng);
         const double at = of.trial.drawing.middle[joint - 1] +
                           0.4 * of.trial.drawing.wide[joint - 1] * rng->Uniform(-1, 1);
         return Causes{Kinked(joint, at, Sign(rng) * strength * 1e-4)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         const int joint = DrawFrom(of.turning, rng), first = Another(of.turning, joint, rng);
         int second = first;
         while (second == first || second == joint) second = DrawFrom(of.turning, rng);
         return Causes{CablePulls(joint, first, second, Sign(rng) * strength * 1e-4)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         const int joint = DrawFrom(of.turning, rng), first = Another(of.turning, joint, rng);
         return Causes{CableTautens(
             joint, first, joint, rng->Uniform(-0.5, 0.8), Sign(rng) * strength * 2e-4)};
       }},
      {1,
       true,
       [](const Subject& of, double strength, Rng* rng) {
         const double period = of.duration() / rng->Uniform(3, 12);
         return Causes{FloorSways(strength * 0.3e-4 * DrawDirection(rng), period)};
       }},
      {1, true, [](const Subject& of, double strength, Rng* rng) {
         const double order = 1.0 + DrawInt(3, rng);
         return Causes{
             RubsByAngle(DrawFrom(of.turning, rng), strength * 0.5e-4, order, Phase(rng))};
       }}};
}

}  // namespace dhcal::concealed
