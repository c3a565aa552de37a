// What effects would do at poses that were not recorded: the error that a hidden one may cause, and
// the poses that would tell two of them apart (PHYSICS.md M4).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_ELSEWHERE_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_ELSEWHERE_H_

#include <vector>

#include "core/model/diagnosis.h"
#include "core/physics/context.h"
#include "problems/calibration.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// Poses all over the joint space around the recorded ones: every joint's recorded middle plus or
/// minus 120 deg, or its recorded range where that is larger; prismatic joints their range twice.
Recording PosesElsewhere(const Recording& recording, const RobotModel& robot, int count);

class Elsewhere {
 public:
  /// All but the last must outlive this. `rows` are those of `context`. `geometry`: parameters that
  /// may take up a part of an effect; effects that the problem file switches on stay as they are.
  Elsewhere(const Calibration& calibration,
            const Eigen::VectorXd& state,
            const PhysicsContext& context,
            const DesignRows& rows,
            const std::vector<Parameter>& geometry);

  /// Visibility, limit and risk of an effect beside the basis of geometry and what is accepted;
  /// `y`: the rows projected off that. May run on several threads at once.
  HiddenRisk Risk(const EffectRequest& request,
                  const Eigen::MatrixXd& basis,
                  const Eigen::VectorXd& y,
                  double sigma_scale) const;

  /// Poses at which `first`, with these parameters, differs most from the best that geometry
  /// and `second` can do with the recorded rows. Largest first, with the difference [m].
  struct Split {
    std::vector<SeparatingPose> poses;
    double largest = 0;       // [m]
    double with_payload = 0;  // [m] at the recorded poses with another payload; 0 = no such
  };
  Split PosesThatSplit(const EffectRequest& first,
                       const Eigen::VectorXd& value,
                       const EffectRequest& second) const;

 private:
  /// d p_WQ / d parameter of a hypothesis elsewhere, less what the geometry that fits the recorded
  /// rows would take of it: 3 x columns per pose.
  Eigen::MatrixXd Moves(const EffectRequest& request,
                        const Eigen::MatrixXd& absorbed,
                        const Recording& poses) const;
  Eigen::MatrixXd Raw(const EffectRequest& request) const;
  /// Geometry that the fit would move per column (tolerances as priors).
  Eigen::MatrixXd Absorbed(const Eigen::MatrixXd& columns) const;

  const Calibration& c_;
  const Eigen::VectorXd& state_;
  const PhysicsContext& context_;
  const DesignRows& rows_;
  std::vector<Parameter> geometry_;
  Eigen::MatrixXd J_;       // whitened, times tolerance
  Eigen::MatrixXd normal_;  // (J'J + I)^-1
  Eigen::VectorXd tolerance_;
  Recording poses_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_ELSEWHERE_H_
