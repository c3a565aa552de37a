// Where a fit starts: base and tool from closed-form alignments, not from zero.
#ifndef DHCAL_PROBLEMS_START_H_
#define DHCAL_PROBLEMS_START_H_

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "problems/calibration.h"
#include "problems/fit.h"
#include "problems/prediction.h"

namespace dhcal {

/// The rigid transform X_WB that best maps points in B to points in W (3 x n each), in the least
/// squares sense: Kabsch (1976), Umeyama (1991) without scale. With fewer than three points, or
/// all on one line, the turn about that line is left as it comes.
Eigen::Isometry3d AlignPoints(const Eigen::Matrix3Xd& p_B, const Eigen::Matrix3Xd& p_W);

/// The rotation that best maps vectors in B to vectors in W.
Eigen::Matrix3d AlignVectors(const Eigen::Matrix3Xd& v_B, const Eigen::Matrix3Xd& v_W);

/// The mean of rotations: the one nearest to their sum (chordal L2 mean).
Eigen::Matrix3d MeanRotation(const std::vector<Eigen::Matrix3d>& rotations);

/// Moves every base (and, where orientations are measured, tool rotation) whose six parameters are
/// all estimated without a prior to its closed-form alignment with the fitted readings (along
/// edges: problems/edge_start.h). Distances have none: they start from the file's base.
void AlignStart(Calibration* calibration);

/// Fits base and tool alone and makes the outcome the start of the full fit (not where a prior
/// holds them to the file's values). What they leave; nothing when none of them is estimated.
std::optional<ResidualStatistics> FitFramesAlone(Calibration* calibration,
                                                 const Progress& progress);

/// Base and tool where the file leaves them, aligned as far as it estimates them; without effects.
Frames AlignedFrames(const ProblemSpec& spec, const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_START_H_
