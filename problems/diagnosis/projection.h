// Takes out of rows what the geometry can explain, and sets aside readings that no model explains.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_

#include <vector>

#include <Eigen/Core>

#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// Orthonormal basis of the columns of J that are independent to `relative_cut` after scaling the
/// columns to unit length. Columns that are zero but for rounding are dropped first: scaling them
/// up would make directions out of nothing (PHYSICS.md M1).
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& J, double relative_cut = 1e-7);

/// Orthonormal basis of the directions of A whose singular value exceeds `cut`. With columns in
/// tolerances and rows in noise and a cut of 1: what a fit by the noise rule can move.
Eigen::MatrixXd BasisAbove(const Eigen::MatrixXd& A, double cut);

/// v without what lies in the basis.
template <typename Derived>
Eigen::MatrixXd ProjectOff(const Eigen::MatrixXd& U, const Eigen::MatrixBase<Derived>& v) {
  return v - U * (U.transpose() * v);
}

struct OutlierRule {
  double most = 0.05;        // of all readings; more are no outliers, and none is flagged
  Eigen::VectorXd leverage;  // per row, of what was taken out beside U; empty = nothing
};

/// Readings that lie further off than a coordinate is at 4.5 standard deviations, by the residuals'
/// own spread (a misfit widens it). Positions and rotations are judged by their length, so that the
/// axes of the measurement frame do not matter. `y`: whitened rows, projected off U.
std::vector<bool> FlagOutliers(const Eigen::VectorXd& y,
                               const Eigen::MatrixXd& U,
                               int coordinates,
                               const OutlierRule& rule = {});

/// True if the flagged readings' residuals point along the motion of one joint, or of one axis of
/// the tool, more than chance allows: then they are a local defect of that joint (a damaged tooth),
/// not outliers. Random directions have mean cos^2 = 1/3, variance 4/45.
bool FollowAJoint(const DesignRows& rows,
                  const Eigen::VectorXd& y,
                  const std::vector<bool>& flagged,
                  int num_joints);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_PROJECTION_H_
