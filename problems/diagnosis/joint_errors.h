// What the delivered model says of a joint's angle, row by row, beside what the readings say of it.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JOINT_ERRORS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JOINT_ERRORS_H_

#include <vector>

#include <Eigen/Core>

#include "core/model/result.h"
#include "problems/calibration.h"

namespace dhcal {

/// Of each joint whose angle (stroke, of a prismatic one) an estimated effect changes at `state`.
/// `residuals` are the model's. The residual of a row is read as an error of that joint alone, by
/// the lever arm that the measured point has about it; rows with a short one are left out. Empty
/// for kinds that measure no point.
std::vector<JointErrors> JointErrorsOf(const Calibration& calibration,
                                       const Eigen::VectorXd& state,
                                       const std::vector<RowResidual>& residuals);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JOINT_ERRORS_H_
