// The parameter table: values, uncertainties, verdicts and their reasons.
#ifndef DHCAL_PROBLEMS_DESCRIBE_PARAMETERS_H_
#define DHCAL_PROBLEMS_DESCRIBE_PARAMETERS_H_

#include <vector>

#include "core/model/result.h"
#include "problems/calibration.h"
#include "problems/fit_analysis.h"

namespace dhcal {

/// Estimated parameters, then fixed ones.
std::vector<ParameterResult> DescribeParameters(const Calibration& calibration,
                                                const Eigen::VectorXd& state,
                                                const FitAnalysis& analysis,
                                                const std::vector<NullDirection>& null_space);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DESCRIBE_PARAMETERS_H_
