// Loads that gravity puts on a place of the chain: full rigid-body statics.
//
// With masses (robot.links) there is one mass case, the robot's own. Without, the torque at a joint
// is linear in the unknown masses and first moments of the links beyond it; a minimal set of these
// (the base parameters of Gautier and Khalil 1990, found here by a pivoted QR) gives one case each,
// and only products such as compliance x moment can be found.
#ifndef DHCAL_CORE_PHYSICS_GRAVITY_H_
#define DHCAL_CORE_PHYSICS_GRAVITY_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/physics/context.h"

namespace dhcal {

/// A distribution of mass. Body i < n is link i in its frame; body n is what is carried, in the
/// flange's frame.
struct MassCase {
  std::string name;             // "" with known masses; "link3_x": the moment of link 3 along its x
  std::string unit;             // "" or "kg m" or "kg": of the unknown that the case stands for
  double typical = 1;           // of that unknown
  Eigen::VectorXd mass;         // [kg], n + 1
  Eigen::Matrix3Xd moment;      // [kg m], 3 x (n + 1): mass x centre of mass
  bool payload_of_row = false;  // body n is scaled from 1 kg to the row's payload
};

/// Force and moment about `point` that gravity exerts on the bodies from `first_body` on, in B.
struct Load {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [N m]
};

Load GravityLoad(const PhysicsContext& context,
                 const MassCase& mass_case,
                 int row_idx,
                 int first_body,
                 const Eigen::Vector3d& point);

/// Gravity's torque about a joint's axis [N m] (force along it [N] for a prismatic joint), all
/// rows. Positive turns the joint in DH's positive sense: a compliant joint yields along it.
Eigen::VectorXd GravityTorque(const PhysicsContext& context, const MassCase& mass_case, int joint);

/// The robot's own case where `links` is given, else the minimal cases of the joint and, where the
/// payload varies, the carried mass as one more.
std::vector<MassCase> MassCases(const PhysicsContext& context, int joint);

/// The minimal cases, whether masses are given or not.
std::vector<MassCase> FreeMassCases(const PhysicsContext& context, int joint);

/// Settings of an effect that needs no more of a load than its sense.
constexpr char kMomentLink[] = "moment_link";    // [from 1]
constexpr char kMomentDegrees[] = "moment_deg";  // [deg]

/// A moment of 1 kg m in a link [from 0], across the axis of its joint, `angle` [rad] about that
/// axis from the link's x.
MassCase OneMoment(const PhysicsContext& context, int link, double angle);

/// The load on a joint from the recording's torque columns [N m], in DH's sense. A column holds the
/// drive's torque (it opposes the load) or the load itself: the sign is the one that goes with
/// gravity where gravity loads the joint, else the drive's.
Eigen::VectorXd MeasuredLoad(const PhysicsContext& context, int joint);

/// True if the recording has a joint's torque in every row.
bool HasMeasuredTorque(const PhysicsContext& context, int joint);

/// Joints (from 0) whose gravity torque varies over the recording; a mass is assumed on every link
/// where none is given.
bool GravityLoads(const PhysicsContext& context, int joint);

/// The first joint that gravity loads, or -1.
int FirstLoadedJoint(const PhysicsContext& context);

/// Arms yield by like angles, whatever their size: by how much more per newton metre a small one
/// does than the arms of 10 kg and more whose usual sizes PHYSICS.md has (E1, E4). 1 for those, and
/// where no masses are given.
double SoftnessOfSize(const PhysicsContext& context);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_GRAVITY_H_
