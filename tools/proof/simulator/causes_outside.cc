// Physics that no library names.
#include <cmath>

#include "core/base/units.h"
#include "tools/proof/simulator/causes.h"

namespace dhcal::concealed {
namespace {

Drive& DriveOf(int joint, Physics* physics) {
  return physics->drives[static_cast<std::size_t>(joint) - 1];
}

}  // namespace

Cause ToothDamaged(int joint, double at, double width, double depth) {
  Cause cause = NamedCause("", joint, "");
  // Outside the library as a mechanism, yet a curve of the joint's own angle.
  cause.also = {"transmission_error"};
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    DriveOf(joint, physics).form = [=](double q) {
      return std::abs(q - at) < width / 2
                 ? scale * depth * 0.5 * (1 + std::cos(2 * kPi * (q - at) / width))
                 : 0.0;
    };
  };
  return cause;
}

Cause Kinked(int joint, double at, double slope) {
  Cause cause = NamedCause("", joint, "");
  // Outside the library as a mechanism, yet a curve of the joint's own angle.
  cause.also = {"transmission_error"};
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    DriveOf(joint, physics).form = [=](double q) { return scale * slope * std::abs(q - at); };
  };
  return cause;
}

Cause RubsByAngle(int joint, double windup, double order, double phase) {
  Cause cause = NamedCause("", joint, "");
  // Outside the library as a law, yet a play in the mean.
  cause.also = {"backlash"};
  cause.apply = [=](Physics* physics, double scale) {
    Drive& drive = DriveOf(joint, physics);
    drive.windup = scale * windup;
    drive.windup_form = [=](double q) { return 1 + std::sin(order * q + phase); };
  };
  return cause;
}

Cause CableTautens(int joint, int first, int second, double slack, double pull) {
  Cause cause = NamedCause("", joint, "");
  cause.apply = [=](Physics* physics, double scale) {
    physics->cross = [=](int which, const Eigen::VectorXd& q) {
      const double reach = q[first - 1] + q[second - 1] - slack;
      return which == joint - 1 && reach > 0 ? scale * pull * reach : 0.0;
    };
  };
  return cause;
}

Cause CablePulls(int joint, int first, int second, double amount) {
  Cause cause = NamedCause("", joint, "");
  cause.apply = [=](Physics* physics, double scale) {
    physics->cross = [=](int which, const Eigen::VectorXd& q) {
      return which == joint - 1 ? scale * amount * q[first - 1] * q[second - 1] : 0.0;
    };
  };
  return cause;
}

Cause FloorSways(const Eigen::Vector3d& amplitude, double period) {
  Cause cause = At(NamedCause("", 0, ""), "base", "base");
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    physics->sway += scale * amplitude;
    physics->sway_period = period;
  };
  return cause;
}

}  // namespace dhcal::concealed
