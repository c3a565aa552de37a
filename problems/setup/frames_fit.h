// Base and tool for a set-up, by linear least squares, and how well the nominal robot then fits.
//
// With y a reading in W, t and R the flange's pose in B, p the tool point in T:
//
//   y = X_WB (t + R p)   <=>   t = C y - c - R p,   C = R_BW, c = C p_WB
//
// which is linear in C (9), c (3) and p (3). What C lacks of a rotation tells units and mirrored
// frames apart; what remains is counted as misfit. Distances are linear in the anchor's place:
//
//   |t|^2 = k d^2 + 2 t.c - |c|^2,   t with the file's tool, corrected in the first order.
#ifndef DHCAL_PROBLEMS_SETUP_FRAMES_FIT_H_
#define DHCAL_PROBLEMS_SETUP_FRAMES_FIT_H_

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "problems/calibration.h"
#include "problems/setup/flange_poses.h"

namespace dhcal {

struct FramesMisfit {
  double rms = std::numeric_limits<double>::infinity();  // [m] in the readings' own lengths
  double scale = 1;       // readings times this are what the robot's lengths are in
  bool mirrored = false;  // the instrument's frame is left-handed
  Eigen::Vector3d p_TQ = Eigen::Vector3d::Zero();
};

/// Bound to the readings of a calibration, which must outlive it. Immutable.
class FramesFit {
 public:
  /// `readings`: at most kMostSetUpRows, all of one run and target or of a robot with one frame.
  FramesFit(const Calibration& calibration, const std::vector<Reading>& readings);

  /// `before`: poses of the rows before, for differences; else not read.
  FramesMisfit Fit(const FlangePoses& now, const FlangePoses& before) const;

 private:
  template <int kColumns>
  using Columns =
      Eigen::Matrix<double, Eigen::Dynamic, kColumns, Eigen::ColMajor, kMostSetUpRows, kColumns>;

  FramesMisfit FitPoints(const FlangePoses& now, const FlangePoses& before) const;
  FramesMisfit FitDistances(const FlangePoses& now) const;
  /// What C of t = C y lacks of one of the scaled rotations.
  void JudgeFrame(const Eigen::Matrix3d& C, double rms_t, FramesMisfit* misfit) const;

  bool pairs_ = false;
  bool distances_ = false;
  Eigen::Matrix3Xd y_;  // 3 x readings [m]
  // Of the basis, readings x (3 or 4): y and, for positions, 1.
  Eigen::MatrixXd orthonormal_, root_;  // its triangular factor
  Eigen::Matrix3d spread_;              // mean of (y - mean)(y - mean)'
  Eigen::VectorXd distance_;            // [m]
  std::vector<int> anchor_;             // of each reading
  int num_anchors_ = 0;
  Eigen::Vector3d tool_;  // the file's
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_FRAMES_FIT_H_
