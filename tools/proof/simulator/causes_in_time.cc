// Causes that depend on the clock, on the row or on the run.
#include <functional>
#include <string>

#include <fmt/format.h>

#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/causes.h"

namespace dhcal::concealed {
namespace {

/// A link that warms up; link 1 before link 2: the order in which the heat goes.
std::function<void(Physics*, double)> WarmsUp(int link, double strain, double lag) {
  return [=](Physics* physics, double scale) {
    ThermalBody body;
    body.link = link;
    body.strain = scale * strain;
    body.lag = lag;
    const auto place = link == 1 ? physics->thermal.begin() : physics->thermal.end();
    physics->thermal.insert(place, body);
  };
}

/// Moves what a slot's name says.
std::function<void(Arm*, double)> MoverOf(const std::string& slot) {
  const std::size_t underscore = slot.find('_');
  if (underscore != std::string::npos) {
    const int axis = slot[underscore + 1] - 'x';
    if (slot.substr(0, underscore) == "base") {
      return [axis](Arm* arm, double x) { arm->base.translation()[axis] += x; };
    }
    return [axis](Arm* arm, double x) {
      arm->tool.translation()[axis] += x;
      for (Eigen::Isometry3d& target : arm->targets) target.translation()[axis] += x;
    };
  }
  const std::size_t number = slot.find_first_of("123456789");
  const std::string name = slot.substr(0, number);
  const std::size_t link = std::stoul(slot.substr(number)) - 1;
  double DrawnLink::*const member = name == "theta" ? &DrawnLink::theta
                                    : name == "d"   ? &DrawnLink::d
                                    : name == "a"   ? &DrawnLink::a
                                                    : &DrawnLink::alpha;
  return [link, member](Arm* arm, double x) { arm->links[link].*member += x; };
}

}  // namespace

Cause FirstLinkGrows(double strain, double lag) {
  Cause cause = At(NamedCause("link_thermal", 1, "C5"), "link 1", "d1");
  cause.settings = {{"time_constant_s", lag}};
  cause.values = {{"strain", strain}};
  cause.apply = WarmsUp(1, strain, lag);
  return cause;
}

Cause SecondLinkGrows(double strain, double lag) {
  Cause cause = At(NamedCause("link_thermal", 2, "C5"), "link 2", "a2");
  cause.settings = {{"time_constant_s", lag}};
  // Behind link 1 where that warms, too: no single exponential, so no size is compared.
  cause.apply = WarmsUp(2, strain, lag);
  return cause;
}

Cause ToolSlips(int at_row, double time, const Eigen::Vector3d& shift) {
  Cause cause = At(NamedCause("tool_step", 0, "C6"), "tool", "tool");
  cause.settings = {{"at_s", time}};
  cause.values = {{"x", shift.x()}, {"y", shift.y()}, {"z", shift.z()}};
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    Step step;
    step.joint = -1;
    step.at_row = at_row;
    step.shift = scale * shift;
    physics->steps.push_back(step);
  };
  return cause;
}

Cause JointSlips(int joint, int at_row, double time, double angle) {
  Cause cause = NamedCause("joint_step", joint, "C6");
  cause.settings = {{"at_s", time}};
  cause.values = {{"step", angle}};
  cause.apply = [=](Physics* physics, double scale) {
    Step step;
    step.joint = joint - 1;
    step.at_row = at_row;
    step.angle = scale * angle;
    physics->steps.push_back(step);
  };
  return cause;
}

Cause Late(double seconds) {
  Cause cause = At(NamedCause("latency", 0, "timing"), "sensor", "theta");
  cause.values = {{"time", seconds}};
  cause.apply = [=](Physics* physics, double scale) { physics->latency += scale * seconds; };
  return cause;
}

Cause BaseSteps(int at_row, double time, const Move& move) {
  Cause cause = At(NamedCause("base_step", 0, "C6"), "base", "base");
  cause.settings = {{"at_s", time}};
  cause.parameters = 6;
  cause.apply = [=](Physics* physics, double scale) {
    Step step;
    step.joint = -2;
    step.at_row = at_row;
    step.base = {scale * move.shift, scale * move.turn};
    physics->steps.push_back(step);
  };
  return cause;
}

Cause BaseDrifts(const Eigen::Vector3d& motion, double lag) {
  Cause cause = At(NamedCause("base_drift", 0, "C5"), "base", "base");
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    Drift drift;
    drift.motion = scale * motion;
    drift.lag = lag;
    physics->drifts.push_back(drift);
  };
  return cause;
}

Cause JointDrifts(int joint, double angle, double lag) {
  Cause cause = NamedCause("joint_drift", joint, "C5");
  cause.apply = [=](Physics* physics, double scale) {
    Drift drift;
    drift.joint = joint - 1;
    drift.angle = scale * angle;
    drift.lag = lag;
    physics->drifts.push_back(drift);
  };
  return cause;
}

Cause BaseMovesBetweenRuns(const std::vector<Move>& moves) {
  Cause cause = At(NamedCause("base_per_run", 0, "geometry"), "base", "base");
  cause.parameters = 6 * (static_cast<int>(moves.size()) - 1);
  cause.apply = [=](Physics* physics, double scale) {
    physics->base_of_run.resize(moves.size());
    for (std::size_t k = 0; k < moves.size(); ++k) {
      physics->base_of_run[k].shift += scale * moves[k].shift;
      physics->base_of_run[k].turn += scale * moves[k].turn;
    }
  };
  return cause;
}

Cause NotSettled(double share) {
  Cause cause = At(NamedCause("settling", 0, "timing"), "all joints", "theta");
  cause.values = {{"share", share}};
  cause.apply = [=](Physics* physics, double scale) { physics->settling += scale * share; };
  return cause;
}

Cause ReadsLong(double offset, int anchors) {
  Cause cause = At(NamedCause("length_offset", 0, ""), "sensor", "base");
  cause.parameters = anchors;
  cause.apply = [=](Physics* physics, double scale) {
    physics->instrument.length_offset += scale * offset;
  };
  return cause;
}

Cause Follows(const std::string& column,
              const std::string& slot,
              const Eigen::VectorXd& course,
              double amount) {
  Cause cause = At(NamedCause("column_driver", 0, "column"), slot, slot);
  cause.words = {{"column", column}, {"slot", slot}};
  cause.apply = [move = MoverOf(slot), course, amount](Physics* physics, double scale) {
    physics->followers.push_back({move, scale * amount * course});
  };
  return cause;
}

Cause InstrumentGrows(double growth, double lag) {
  Cause cause = At(NamedCause("instrument_drift", 0, "C5"), "sensor", "base");
  cause.settings = {{"time_constant_s", lag}};
  cause.values = {{"scale", growth}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->instrument.growth += scale * growth;
    physics->instrument.lag = lag;
  };
  return cause;
}

}  // namespace dhcal::concealed
