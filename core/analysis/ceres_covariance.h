// Covariance blocks from ceres::Covariance (SuiteSparse QR), to check the SVD's own.
#ifndef DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_
#define DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_

#include <string>
#include <vector>

#include "core/analysis/identifiability.h"
#include "core/model/parameter.h"
#include "core/solver/estimation_problem.h"

namespace dhcal {

struct CovarianceCheck {
  std::string sentence;         // what was compared and the outcome
  double difference = kNotSet;  // largest relative difference of sigma among those compared
  std::vector<double> sigma;    // from Ceres; NaN = held or not compared
};

/// At the problem's state. With undetermined directions one pivot parameter of each is held
/// constant; the variances of identified parameters must not depend on that choice, and are
/// compared. Held parameters are variable again afterwards.
CovarianceCheck CheckAgainstCeres(const Identifiability& identifiability,
                                  const std::vector<Parameter>& parameters,
                                  EstimationProblem* problem);

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_CERES_COVARIANCE_H_
