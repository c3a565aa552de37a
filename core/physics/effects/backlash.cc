// Lost motion of a joint: which flank of the gear touches.
//
//   d theta_j = (b / 2) s_j                  b [rad] full width; a prismatic joint: d d_j, b [m]
//
// s_j = sense of the last motion (the `dir` columns, else from the previous row of the run). With
// the setting flank = 1 gravity preloads the gear and decides: s_j = sign of gravity's torque where
// that is beyond friction_Nm; within, the last motion decides, and the link stays behind the motor.
// Of a joint that may count modulo a turn nobody knows how it came across more than half of one:
// the setting jumps = 1 takes it as counted, -1 the short way, 0 as not known (s_j = 0).
// Where no masses are known the load's sense needs no more than the direction of one moment: of
// 1 kg m in link moment_link, across the axis of that link's joint, moment_deg from the link's x.
// Friction wind-up looks the same (the residual friction torque changes sign with the approach):
// nothing in static readings tells the two apart, so the finding names both.
// b < 0 by approach direction is no play: the controller overcompensates, or it is wind-up of the
// measured side.
// Typical: 0.1-0.3 mrad (RV lost motion 1 arcmin). Source: PHYSICS.md B1, F1.
// Worked number: b = 0.3 mrad, last motion in the negative sense: -0.15 mrad.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr double kTypicalAngle = 2e-4;   // [rad]
constexpr double kTypicalLength = 5e-5;  // [m] of a rack or a ball screw
constexpr char kFriction[] = "friction_Nm";
constexpr char kJumps[] = "jumps";

bool ByTorque(const EffectRequest& request) { return request.setting("flank", 0) != 0; }

/// The link [from 0] whose moment stands for all masses, or -1.
int MomentLink(const EffectRequest& request) {
  return static_cast<int>(request.setting(kMomentLink, 0)) - 1;
}

Eigen::VectorXd Torque(const PhysicsContext& c, const EffectRequest& request) {
  const int joint = JointIndex(request), link = MomentLink(request);
  return GravityTorque(c,
                       link >= 0 ? OneMoment(c, link, request.setting(kMomentDegrees, 0) * kDegree)
                                 : MassCases(c, joint).front(),
                       joint);
}

Eigen::VectorXd Flank(const PhysicsContext& c, const EffectRequest& request) {
  const int joint = JointIndex(request);
  if (!ByTorque(request)) {
    return c.direction().col(joint) +
           request.setting(kJumps, 0) * c.direction_as_counted().col(joint);
  }
  const double friction = request.setting(kFriction, 0);
  Eigen::VectorXd flank = Torque(c, request);
  for (Eigen::Index row = 0; row < flank.size(); ++row) {
    const double torque = flank[row];
    flank[row] = torque > friction    ? 1.0
                 : torque < -friction ? -1.0
                 : friction > 0       ? -c.direction()(row, joint)
                                      : 0.0;
  }
  return flank;
}

/// The approach direction with the ways across more than half a turn known.
std::vector<EffectRequest> WithJumps(const PhysicsContext& c, const EffectRequest& approached) {
  if (c.direction_as_counted().col(JointIndex(approached)).isZero(0)) return {};
  std::vector<EffectRequest> variants(2, approached);
  variants[0].settings[kJumps] = 1;
  variants[1].settings[kJumps] = -1;
  return variants;
}

/// The loaded flanks of which friction takes some of the rows: it is not known, so shares of the
/// torques there are stand for it.
std::vector<EffectRequest> WithFriction(const PhysicsContext& c, const EffectRequest& loaded) {
  constexpr double kShares[] = {0.2, 0.4, 0.6, 0.8};
  Eigen::VectorXd torque = Torque(c, loaded).cwiseAbs();
  std::sort(torque.begin(), torque.end());
  std::vector<EffectRequest> variants;
  for (const double share : kShares) {
    EffectRequest variant = loaded;
    const double friction =
        torque[static_cast<Eigen::Index>(share * static_cast<double>(torque.size() - 1))];
    variant.settings[kFriction] = friction;
    if (friction > 0) variants.push_back(std::move(variant));
  }
  return variants;
}

std::string Decides(const EffectRequest& request) {
  if (!ByTorque(request)) {
    const double jumps = request.setting(kJumps, 0);
    return std::string("the approach direction") +
           (jumps > 0   ? " (moves beyond half a turn as they are counted)"
            : jumps < 0 ? " (moves beyond half a turn went the short way)"
                        : "");
  }
  const double friction = request.setting(kFriction, 0);
  if (MomentLink(request) >= 0) {
    return fmt::format(
        "the sign of a gravity torque that was found with it (moment of link {} at "
        "{:.0f} deg from its x)",
        MomentLink(request) + 1,
        request.setting(kMomentDegrees, 0));
  }
  if (friction == 0) return "the sign of its gravity torque";
  return fmt::format(
      "the sign of its gravity torque, and within {:.2g} N m on the approach direction", friction);
}

class BacklashEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"backlash",
            "play or friction wind-up: a joint stops short, depending on the approach",
            "d theta_j = (b / 2) s_j",
            "width [rad], of a prismatic joint [m]",
            {{"flank", "0 = approach direction, 1 = sign of gravity torque"},
             {kJumps, "moves beyond half a turn: 1 as counted, -1 the short way, 0 not known"},
             {kFriction, "with flank = 1: below it the approach direction decides [N m]"},
             {kMomentLink, "with flank = 1 and no masses: the link whose 1 kg m loads the joint"},
             {kMomentDegrees, "its direction about that link's joint axis, from its x [deg]"}},
            "dir<j>, or poses in the order of the motion; robot.links with flank = 1",
            "0.1-0.3 mrad [PHYSICS.md B1, F1]"};
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    if (ByTorque(request)) {
      if (const int link = MomentLink(request); link >= 0) {
        if (link < JointIndex(request) || link >= c.num_joints() || !c.revolute(link)) {
          return fmt::format(
              "moment_link: {} is no turning link that joint {} carries", link + 1, request.joint);
        }
      } else if (c.robot().links.empty()) {
        return "the masses (robot.links) are not given";
      }
      if (!GravityLoads(c, JointIndex(request))) return "gravity does not load this joint";
    }
    const Eigen::VectorXd flank = Flank(c, request);
    const double share = (flank.array() > 0).cast<double>().mean();
    // A handful of rows on the other side are no experiment.
    if (share < 0.02 || share > 0.98) return "all poses are approached from the same side";
    return "";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const bool turns = c.revolute(joint);
    return {SlotColumn("width",
                       turns ? "rad" : "m",
                       turns ? kTypicalAngle : kTypicalLength,
                       c.joint_slot(joint),
                       0.5 * Flank(c, request))};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests =
        WithVariant(*this, c, EveryJoint(c, "backlash", /*revolute_only=*/false), "flank");
    const std::vector<EffectRequest> plain = requests;
    for (const EffectRequest& request : plain) {
      if (!ByTorque(request)) {
        for (EffectRequest& variant : WithJumps(c, request)) requests.push_back(std::move(variant));
        continue;
      }
      if (c.direction().col(JointIndex(request)).isZero(0)) continue;
      for (EffectRequest& variant : WithFriction(c, request))
        requests.push_back(std::move(variant));
    }
    return requests;
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {"C4",
            JointName(request.joint),
            ByTorque(request) ? "sign of gravity torque" : "approach direction"};
  }
  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue width = Find(values, "width");
    return fmt::format("{} has {} of backlash (or friction wind-up), depending on {}",
                       JointWords(context, request.joint),
                       AmountOfJoint(width),
                       Decides(request));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "backlash";
    example.request.joint = 4;
    example.request.values["width"] = 3e-4;
    example.row = 2;
    example.slot = "theta4";
    example.expected = -1.5e-4;
    return example;
  }
};

}  // namespace

const Effect& Backlash() {
  static const BacklashEffect effect;
  return effect;
}

}  // namespace dhcal
