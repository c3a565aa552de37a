// Arms as drawn, and as product of exponentials: p = B exp(xi_1 q_1) ... exp(xi_n q_n) M.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_ARM_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_ARM_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "tools/proof/simulator/screw.h"

namespace dhcal::concealed {

/// One link of a drawing: a standard DH row with Hayati's angle, and its mass.
struct DrawnLink {
  double theta = 0, d = 0, a = 0, alpha = 0, beta = 0;  // [rad], [m]
  double mass = 0;                                      // [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();        // [m] in the frame at the link's end
};

/// A drawing with what an engineer knows about the arm.
struct Arm {
  std::string name, title;
  std::vector<DrawnLink> links;
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  // measurement frame to base
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  // flange to measured point
  double payload = 0;                                      // [kg]
  Eigen::Vector3d payload_com = Eigen::Vector3d::Zero();   // [m] in the flange frame
  // Sizes that are usual for such an arm.
  double noise = 0.03e-3;                // [m] of a measured coordinate
  double main_compliance = 3e-6;         // [rad/(N m)] joints 1 to 3
  double wrist_compliance = 30e-6;       // [rad/(N m)]
  double base_compliance = 3e-7;         // [rad/(N m)]
  Eigen::VectorXd middle, wide, narrow;  // [rad] middle of the work and half ranges

  int num_joints() const { return static_cast<int>(links.size()); }
};

/// KUKA KR 15/2, Universal Robots UR10, and a small arm of ABB IRB 120 size. Masses of the KR 15
/// and of the tools are rough figures.
Arm KukaKr15();
Arm UniversalUr10();
Arm SmallArm();

/// The arm that was built: mastering 3 mrad, angles 1 mrad, lengths 0.3 mm, Hayati's angle 0.4 mrad
/// between axes drawn parallel, base and tool off by some millimetres and milliradians.
Arm AsBuilt(const Arm& drawing, Rng* rng);

/// The axes of an arm in the base frame at zero joint angles, and all frames there.
class ScrewArm {
 public:
  explicit ScrewArm(const Arm& arm);

  int num_joints() const { return static_cast<int>(axes_.size()); }
  /// Motion of every link from its home: element i of link i (0 = base, which stays). `bends[i]`
  /// displaces link i's far end, in the frame there.
  std::vector<Eigen::Isometry3d> Motions(const Eigen::VectorXd& q,
                                         const std::vector<Eigen::Isometry3d>& bends) const;

  const Screw& axis(int joint) const { return axes_[static_cast<std::size_t>(joint)]; }
  /// Frame at the far end of link i at home; 0 = base.
  const Eigen::Isometry3d& home(int link) const { return homes_[static_cast<std::size_t>(link)]; }

 private:
  std::vector<Screw> axes_;
  std::vector<Eigen::Isometry3d> homes_;
};

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_ARM_H_
