// Poses and their derivatives for all rows of a fit, computed once per evaluation point.
#ifndef DHCAL_RESIDUALS_POSE_CACHE_H_
#define DHCAL_RESIDUALS_POSE_CACHE_H_

#include <vector>

#include <Eigen/Core>
#include <ceres/evaluation_callback.h>

#include "core/kinematics/dh_chain.h"
#include "residuals/running_means.h"

namespace dhcal {

/// What an effect's parameter adds to a slot of one row (core/physics/effect.h).
struct EffectTerm {
  int column = 0;     // position among the scope's parameters
  int slot = 0;       // [rad or m]
  double weight = 0;  // slot's unit per unit of the parameter
};

/// What effects with given values add to a slot of one row.
struct HeldTerm {
  int slot = 0;
  double amount = 0;  // [rad or m]
};

/// What is the same for all rows of one run and target: the nominal frames at the chain's ends
/// and the parameters that these rows depend on.
struct Scope {
  EndFrames ends;
  std::vector<int> parameters;  // indices into the state, ascending
  std::vector<int> slots;       // slot that each of them is added to; -1 = an effect's
};

/// One recorded pose.
struct CacheRow {
  Eigen::VectorXd q;  // n, as the controller reported it [rad] or [m]
  int scope = 0;
  std::vector<EffectTerm> effects;
  std::vector<HeldTerm> held;
};

/// Fills a structure-of-arrays store before Ceres evaluates; residual blocks only read it. Two
/// blocks share each pose of an adjacent pair, so computing in the blocks would do all twice.
class PoseCache : public ceres::EvaluationCallback {
 public:
  /// `chain` and `state` (one scalar per parameter) must outlive the cache.
  PoseCache(const DhChain* chain,
            std::vector<Scope> scopes,
            std::vector<CacheRow> rows,
            const std::vector<double>* state,
            bool with_orientation);

  /// Also keeps, per row, the weighted mean over the earlier rows of its series.
  void EnableRunningMeans(RunningMeans means);

  /// Computes all rows at the state, unless they stand there already.
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  int num_rows() const { return static_cast<int>(rows_.size()); }
  const Scope& scope(int row_idx) const {
    return scopes_[static_cast<std::size_t>(rows_[static_cast<std::size_t>(row_idx)].scope)];
  }

  /// Position of Q in W [m].
  auto p_WQ(int row_idx) const { return p_WQ_.col(row_idx); }
  /// Orientation of Q in W; only with orientation.
  const Eigen::Matrix3d& R_WQ(int row_idx) const {
    return R_WQ_[static_cast<std::size_t>(row_idx)];
  }
  /// d p_WQ / d state, 3 x scope(row).parameters.size().
  auto J_p(int row_idx) const { return Block(J_p_, row_idx); }
  /// Rotation of Q in W per state [rad], same shape; only with orientation.
  auto J_w(int row_idx) const { return Block(J_w_, row_idx); }
  /// Means over the earlier rows of the series; only with running means.
  const RunningMeans& means() const { return means_; }

 private:
  Eigen::Block<const Eigen::Matrix3Xd, 3, Eigen::Dynamic, true> Block(const Eigen::Matrix3Xd& all,
                                                                      int row_idx) const {
    return all.middleCols(Eigen::Index{row_idx} * stride_,
                          static_cast<Eigen::Index>(scope(row_idx).parameters.size()));
  }
  void ComputePositions();
  void ComputeWithDerivatives();
  Eigen::VectorXd SlotDeltas(const Scope& scope) const;
  /// Perturbation of a row's slots; `of_scope` belongs to its scope.
  Eigen::VectorXd RowDeltas(const CacheRow& row, const Eigen::VectorXd& of_scope) const;
  void FillColumns(const PoseWithDerivatives& pose, int row_idx);

  const DhChain* chain_;
  std::vector<Scope> scopes_;
  std::vector<CacheRow> rows_;
  const std::vector<double>* state_;
  bool with_orientation_;
  Eigen::Index stride_ = 0;  // columns reserved per row

  Eigen::Matrix3Xd p_WQ_;
  std::vector<Eigen::Matrix3d> R_WQ_;
  Eigen::Matrix3Xd J_p_, J_w_;
  RunningMeans means_;

  std::vector<double> state_of_poses_, state_of_derivatives_;
};

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_POSE_CACHE_H_
