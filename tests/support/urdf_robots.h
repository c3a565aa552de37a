// URDFs that the tests read: as their makers publish the robots, or built to be awkward.
#ifndef DHCAL_TESTS_SUPPORT_URDF_ROBOTS_H_
#define DHCAL_TESTS_SUPPORT_URDF_ROBOTS_H_

#include <ostream>
#include <string>
#include <vector>

#include "core/base/rng.h"

namespace dhcal {

struct UrdfRobot {
  std::string name;
  std::string base_link, tip_link;
  std::vector<std::string> joints;  // that move, base to tip
  std::string text;
};

/// UR10 as ur_description has it (2 fixed joints before, 2 behind, meshes, masses, comments), KR 15
/// with its axes along +-x, +-y, +-z and a joint without <origin>, Panda with fingers beside its
/// chain, a SCARA with a slide, the seven axes of an LBR iiwa.
std::vector<UrdfRobot> PublishedUrdfs();

/// Axes in any position: parallel, antiparallel, 1e-6 rad from parallel, intersecting or skew, in
/// link frames turned at random; every third joint a slide.
UrdfRobot RandomUrdf(int num_joints, Rng* rng);

/// The published ones and eight random ones.
std::vector<UrdfRobot> AllUrdfs();

/// For GoogleTest's messages.
std::ostream& operator<<(std::ostream& os, const UrdfRobot& robot);

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_URDF_ROBOTS_H_
