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

enum class Convention { kStandard, kModified };

/// One link of a drawing: a DH row with Hayati's angle, and its mass.
struct DrawnLink {
  double theta = 0, d = 0, a = 0, alpha = 0, beta = 0;  // [rad], [m]
  double mass = 0;                                      // [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();        // [m] in the frame of the row
  bool slides = false;                                  // along z instead of turning about it
};

/// A drawing with what an engineer knows about the arm.
struct Arm {
  std::string name, title;
  Convention convention = Convention::kStandard;
  std::vector<DrawnLink> links;
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  // measurement frame to base
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  // flange to measured point
  std::vector<Eigen::Isometry3d> targets;                  // instead of the tool, where several
  double payload = 0;                                      // [kg]
  Eigen::Vector3d payload_com = Eigen::Vector3d::Zero();   // [m] in the flange frame
  // Sizes that are usual for such an arm.
  double noise = 0.03e-3;                // [m] of a measured coordinate
  double main_compliance = 3e-6;         // [rad/(N m)] joints 1 to 3
  double wrist_compliance = 30e-6;       // [rad/(N m)]
  double base_compliance = 3e-7;         // [rad/(N m)]
  Eigen::VectorXd middle, wide, narrow;  // [rad], slides [m]: middle of the work and half ranges

  int num_joints() const { return static_cast<int>(links.size()); }
  int num_targets() const { return targets.empty() ? 1 : static_cast<int>(targets.size()); }
  const Eigen::Isometry3d& target(int k) const {
    return targets.empty() ? tool : targets[static_cast<std::size_t>(k)];
  }
};

/// True if the axes of joint i and of the next (from 0) are drawn parallel, so that DH rows alone
/// cannot tilt them; i from 0. `*row`: the row whose Hayati angle does.
bool DrawnParallel(const Arm& drawing, int joint, int* row);

/// The arm that was built: mastering 3 mrad, angles 1 mrad, lengths 0.3 mm, Hayati's angle 0.4 mrad
/// between axes drawn parallel, base and tool off by some millimetres and milliradians.
Arm AsBuilt(const Arm& drawing, Rng* rng);

/// Base, tool and tilts of parallel axes as drawn, the rows off as in AsBuilt.
Arm AsBuiltInRowsOnly(const Arm& drawing, Rng* rng);

/// The axes of an arm in the base frame at zero joint angles, and all frames there.
class ScrewArm {
 public:
  explicit ScrewArm(const Arm& arm);

  int num_joints() const { return static_cast<int>(axes_.size()); }
  /// Motion of every link from its home: element i of link i (0 = base, which stays). `bends[i]`
  /// displaces link i's far end, in the frame `end` there; `tilts[i]` [rad] tilts joint i's axis
  /// about x and y of its fixed frame (empty = none).
  std::vector<Eigen::Isometry3d> Motions(const Eigen::VectorXd& q,
                                         const std::vector<Eigen::Isometry3d>& bends,
                                         const std::vector<Eigen::Vector2d>& tilts = {}) const;

  const Screw& axis(int joint) const { return axes_[static_cast<std::size_t>(joint)]; }
  /// Frame of row i at home; 0 = base. The masses are given in it.
  const Eigen::Isometry3d& home(int link) const { return homes_[static_cast<std::size_t>(link)]; }
  /// Joint i's axis (from 0) where its link begins, before the joint moves.
  const Eigen::Isometry3d& start(int joint) const {
    return starts_[static_cast<std::size_t>(joint)];
  }
  /// The far end of joint i's link: a standard row's frame, or where the next modified row begins.
  const Eigen::Isometry3d& end(int joint) const { return ends_[static_cast<std::size_t>(joint)]; }

 private:
  std::vector<Screw> axes_;
  std::vector<Eigen::Isometry3d> homes_, starts_, ends_;
};

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_ARM_H_
