// The directions that the readings do not determine, in parameter names and in words.
#ifndef DHCAL_CORE_ANALYSIS_NULL_SPACE_H_
#define DHCAL_CORE_ANALYSIS_NULL_SPACE_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/math/truncated_svd.h"
#include "core/model/parameter.h"
#include "core/model/problem_spec.h"
#include "core/model/result.h"
#include "core/model/robot.h"

namespace dhcal {

/// A basis of the span of the columns of `directions` (n x k, orthonormal) whose vectors have as
/// few entries as Gauss-Jordan elimination with complete pivoting gives; k x n, pivots 1.
Eigen::MatrixXd SparseBasis(const Eigen::MatrixXd& directions);

/// The dropped directions of `svd` as sparse combinations of the parameters, each with a sentence.
std::vector<NullDirection> ExplainNullSpace(const TruncatedSvd& svd,
                                            const std::vector<Parameter>& parameters,
                                            const RobotModel& robot,
                                            const MeasurementKind& kind);

/// True if the axes that theta_i and theta_j turn about are parallel at every pose up to a degree
/// (only rows without twist between them): so near that plain DH needs Hayati's beta, also when the
/// rows are those of an earlier calibration. Joints count from 0.
bool AxesParallel(const RobotModel& robot, int joint_i, int joint_j);

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_NULL_SPACE_H_
