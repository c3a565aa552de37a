// The causes that scenarios put in, each with the name that the effect library should give it.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_

#include "tools/proof/simulator/trial.h"

namespace dhcal::concealed {

/// Joints and links count from 1.
Cause Yields(int joint, double compliance);
Cause YieldsSoftly(int joint, double compliance, double soft_torque);
Cause BaseYields(double compliance);
/// The spring works on the compliance of joint 2: put that in, too.
Cause Balanced(double stiffness);
Cause GearErrs(int joint, double order, double amplitude, double phase);
Cause Plays(int joint, double gap);
Cause PlaysUnderLoad(int joint, double gap, double preload);
Cause WindsUp(int joint, double windup);
Cause Coupled(int joint, int driver, double ratio);
/// Link 1 warms up, link 2 behind it.
Cause FirstLinkGrows(double strain, double lag);
Cause SecondLinkGrows(double strain, double lag);
Cause ToolSlips(int at_row, double time, const Eigen::Vector3d& shift);
Cause JointSlips(int joint, int at_row, double time, double angle);
Cause Late(double seconds);
Cause ToothDamaged(int joint, double at, double width, double depth);
Cause Kinked(int joint, double at, double slope);
Cause CablePulls(int joint, int first, int second, double amount);
Cause FloorSways(const Eigen::Vector3d& amplitude, double period);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_
