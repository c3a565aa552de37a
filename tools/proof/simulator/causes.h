// The causes that scenarios and random trials put in, each with the name that the effect library
// should give it.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/proof/simulator/cause.h"

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
/// A wrong ratio of the joint itself.
Cause Gains(int joint, double gain);
Cause Wobbles(int joint, double amplitude, double phase);
Cause LinkBends(int link, double flexibility);
/// Link 1 warms up, link 2 behind it.
Cause FirstLinkGrows(double strain, double lag);
Cause SecondLinkGrows(double strain, double lag);
Cause ToolSlips(int at_row, double time, const Eigen::Vector3d& shift);
Cause JointSlips(int joint, int at_row, double time, double angle);
Cause BaseSteps(int at_row, double time, const Move& move);
Cause BaseDrifts(const Eigen::Vector3d& motion, double lag);
Cause JointDrifts(int joint, double angle, double lag);
/// The instrument was set up anew for each run, and the file does not say so.
Cause BaseMovesBetweenRuns(const std::vector<Move>& moves);
Cause Late(double seconds);
Cause NotSettled(double share);
Cause ReadsLong(double offset, int anchors);
/// A slot (in the words of FORMATS.md: "theta3", "a2", "base_x", "tool_z") moves by `amount` [rad
/// or m] times `course`, one number per row, of which a column of this name is what was recorded.
Cause Follows(const std::string& column,
              const std::string& slot,
              const Eigen::VectorXd& course,
              double amount);
/// The instrument warms up, and its unit of length with it.
Cause InstrumentGrows(double growth, double lag);

// Of a measuring head over straight edges.
Cause EdgeIsBowed(double curvature);
Cause RuledFaceClimbs(double angle);
Cause RuledFaceHigher(double height);
/// Offsets in the camera's image read too long by this share.
Cause PixelsWrong(double share);
/// Lasers count from 1; angles [rad] about the tool's x and y.
Cause BeamSlants(int laser, const Eigen::Vector2d& angles);
Cause LaserBends(int laser, double quadratic, double cubic);

// Outside the library.
Cause ToothDamaged(int joint, double at, double width, double depth);
Cause Kinked(int joint, double at, double slope);
/// Turned by the product of two other joints' angles.
Cause CablePulls(int joint, int first, int second, double amount);
/// Slack until two angles together reach `slack` [rad].
Cause CableTautens(int joint, int first, int second, double slack, double pull);
/// Friction that winds up more at some angles than at others.
Cause RubsByAngle(int joint, double windup, double order, double phase);
Cause FloorSways(const Eigen::Vector3d& amplitude, double period);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_CAUSES_H_
