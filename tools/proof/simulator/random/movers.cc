#include "tools/proof/simulator/random/movers.h"

#include <cstddef>

#include "tools/proof/simulator/random/observe.h"
#include "tools/proof/simulator/screw.h"
#include "tools/proof/simulator/truth.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Mover TurnFrame(Isometry3d Arm::*frame, int axis) {
  return [frame, axis](World* world, double x) {
    Isometry3d& X = world->arm.*frame;
    X = X * Displacement(x * Vector3d::Unit(axis), Vector3d::Zero());
  };
}

/// Rows and tilts of parallel axes.
void AddRows(const RandomTrial& trial, std::vector<Mover>* movers) {
  const int n = trial.built.num_joints();
  for (std::size_t i = 0; i < trial.built.links.size(); ++i) {
    for (double DrawnLink::*const member :
         {&DrawnLink::theta, &DrawnLink::d, &DrawnLink::a, &DrawnLink::alpha}) {
      movers->emplace_back(
          [i, member](World* world, double x) { world->arm.links[i].*member += x; });
    }
  }
  for (int joint = 0, row = 0; joint < n; ++joint) {
    if (!DrawnParallel(trial.drawing, joint, &row)) continue;
    const auto i = static_cast<std::size_t>(row);
    movers->emplace_back([i](World* world, double x) { world->arm.links[i].beta += x; });
  }
}

void AddFrames(const RandomTrial& trial, std::vector<Mover>* movers) {
  for (int axis = 0; axis < 3; ++axis) {
    movers->push_back(TurnFrame(&Arm::base, axis));
    movers->emplace_back(
        [axis](World* world, double x) { world->arm.base.translation()[axis] += x; });
    for (std::size_t run = 1; run < trial.setups.size(); ++run) {
      movers->emplace_back([run, axis](World* world, double x) {
        world->physics.base_of_run[run].shift[axis] += x;
      });
      movers->emplace_back(
          [run, axis](World* world, double x) { world->physics.base_of_run[run].turn[axis] += x; });
    }
    movers->push_back(TurnFrame(&Arm::tool, axis));
    movers->emplace_back(
        [axis](World* world, double x) { world->arm.tool.translation()[axis] += x; });
    for (std::size_t k = 0; k < trial.built.targets.size(); ++k) {
      movers->emplace_back(
          [k, axis](World* world, double x) { world->arm.targets[k].translation()[axis] += x; });
      movers->emplace_back([k, axis](World* world, double x) {
        Isometry3d& target = world->arm.targets[k];
        target = target * Displacement(x * Vector3d::Unit(axis), Vector3d::Zero());
      });
    }
  }
}

}  // namespace

std::vector<Mover> GeometryMovers(const RandomTrial& trial) {
  std::vector<Mover> movers;
  AddRows(trial, &movers);
  AddFrames(trial, &movers);
  return movers;
}

std::vector<Mover> JointMovers(const Arm& arm) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    movers.emplace_back([i](World* world, double x) {
      DrawnLink& link = world->arm.links[i];
      (link.slides ? link.d : link.theta) += x;
    });
  }
  return movers;
}

std::vector<Mover> MassMovers(const Arm& arm) {
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    movers.emplace_back([i](World* world, double x) { world->arm.links[i].mass += x; });
    for (int axis = 0; axis < 3; ++axis) {
      movers.emplace_back(
          [i, axis](World* world, double x) { world->arm.links[i].com[axis] += x; });
    }
  }
  return movers;
}

VectorXd Seen(const RandomTrial& trial,
              const World& world,
              const std::vector<Isometry3d>& reference) {
  return Observe(trial,
                 TruePoses(world.arm, world.physics, trial.motion),
                 reference,
                 world.physics.instrument);
}

MatrixXd Derivatives(const RandomTrial& trial,
                     const World& world,
                     const std::vector<Mover>& movers,
                     double step) {
  const std::vector<Isometry3d> reference = TruePoses(world.arm, world.physics, trial.motion);
  MatrixXd derivatives(Seen(trial, world, reference).size(), static_cast<Index>(movers.size()));
  for (std::size_t k = 0; k < movers.size(); ++k) {
    World more = world, less = world;
    movers[k](&more, step);
    movers[k](&less, -step);
    derivatives.col(static_cast<Index>(k)) =
        (Seen(trial, more, reference) - Seen(trial, less, reference)) / (2 * step);
  }
  return derivatives;
}

}  // namespace dhcal::concealed
