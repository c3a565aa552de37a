// The arm that a calibrated.yaml describes: where it really stands for joint commands.
#ifndef DHCAL_TOOLS_COMPENSATE_REAL_ARM_H_
#define DHCAL_TOOLS_COMPENSATE_REAL_ARM_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/diagnostics.h"
#include "core/kinematics/inverse_kinematics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/physics/effect.h"

namespace dhcal {

/// What a parameter of an effect adds to slots, per row.
struct EffectMove {
  std::string parameter;  // "joint_compliance.2.compliance"
  double value = 0;       // SI
  std::vector<SlotWeights> slots;
};

/// Geometry and held effects of a problem file. `rows` gives what stands beside the joint
/// coordinates: payload, approach directions, runs, targets.
class RealArm {
 public:
  /// Effects that cannot be predicted are left out, each with a warning; values that have no
  /// meaning at these rows are errors. `spec` and `rows` must outlive the arm.
  RealArm(const ProblemSpec& spec, const Recording& rows, Diagnostics* diagnostics);

  const DhChain& chain() const { return inverse_.chain(); }
  const InverseKinematics& inverse() const { return inverse_; }

  /// What effects add to the slots (slots x rows) with the joints at `q` (rows x joints), on the
  /// arm that they bend.
  Eigen::MatrixXd Deltas(const Eigen::MatrixXd& q) const;
  /// The weights behind it, on the arm that `deltas` describes.
  std::vector<EffectMove> Moves(const Eigen::MatrixXd& q, const Eigen::MatrixXd& deltas) const;
  /// Frames at the ends of the chain for a row, base in the measurement frame.
  const EndFrames& ends(int row_idx) const { return ends_[static_cast<std::size_t>(row_idx)]; }
  ChainState StateOf(const Eigen::MatrixXd& deltas, int row_idx) const {
    return {deltas.col(row_idx), ends(row_idx)};
  }
  /// X_WQ of a row.
  Eigen::Isometry3d Pose(const Eigen::MatrixXd& q,
                         const Eigen::MatrixXd& deltas,
                         int row_idx) const;

 private:
  Recording Padded(const Eigen::MatrixXd& q) const;
  void KeepPredictable(Diagnostics* diagnostics);
  bool CheckValues(const EffectRequest& effect, Diagnostics* diagnostics) const;

  const ProblemSpec& spec_;
  const Recording& rows_;
  InverseKinematics inverse_;
  std::vector<EndFrames> ends_;
  std::vector<EffectRequest> effects_;
};

}  // namespace dhcal

#endif  // DHCAL_TOOLS_COMPENSATE_REAL_ARM_H_
