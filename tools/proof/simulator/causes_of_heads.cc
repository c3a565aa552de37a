// Causes within a measuring head and its straight edge.
#include "tools/proof/simulator/causes.h"

namespace dhcal::concealed {
namespace {

/// Named by itself alone: no class stands for it.
Cause OfSensor(const std::string& effect) {
  return At(NamedCause(effect, 0, ""), "sensor", "base");
}

}  // namespace

Cause EdgeIsBowed(double curvature) {
  Cause cause = OfSensor("edge_bow");
  cause.values = {{"curvature", curvature}};
  cause.apply = [=](Physics* physics, double scale) { physics->head.bow += scale * curvature; };
  return cause;
}

Cause RuledFaceClimbs(double angle) {
  Cause cause = OfSensor("edge_misalignment");
  cause.values = {{"pitch", angle}};
  cause.apply = [=](Physics* physics, double scale) { physics->head.climb += scale * angle; };
  return cause;
}

Cause RuledFaceHigher(double height) {
  Cause cause = OfSensor("camera_abbe");
  cause.values = {{"height", height}};
  cause.apply = [=](Physics* physics, double scale) {
    physics->head.ruled_height += scale * height;
  };
  return cause;
}

Cause PixelsWrong(double share) {
  Cause cause = OfSensor("camera_scale");
  cause.values = {{"scale", share}};
  cause.apply = [=](Physics* physics, double scale) { physics->head.pixel += scale * share; };
  return cause;
}

Cause BeamSlants(int laser, const Eigen::Vector2d& angles) {
  Cause cause = OfSensor("laser_tilt");
  cause.settings = {{"laser", laser}};
  cause.parameters = 2;
  cause.apply = [=](Physics* physics, double scale) {
    physics->head.slant[static_cast<std::size_t>(laser) - 1] += scale * angles;
  };
  return cause;
}

Cause LaserBends(int laser, double quadratic, double cubic) {
  Cause cause = OfSensor("laser_linearity");
  cause.settings = {{"laser", laser}};
  // Of a bent line about another middle only the cubic term is the same.
  cause.values = {{"cubic_laser" + std::to_string(laser), cubic}};
  cause.parameters = 3;
  cause.apply = [=](Physics* physics, double scale) {
    physics->head.bent[static_cast<std::size_t>(laser) - 1] +=
        scale * Eigen::Vector2d(quadratic, cubic);
  };
  return cause;
}

}  // namespace dhcal::concealed
