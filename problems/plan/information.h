// What readings say of parameters, as Fisher information: whitened rows, columns in the units of
// the parameters' tolerances. Its inverse, with one for what the tolerances know, is a covariance.
#ifndef DHCAL_PROBLEMS_PLAN_INFORMATION_H_
#define DHCAL_PROBLEMS_PLAN_INFORMATION_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "problems/calibration.h"

namespace dhcal {

/// Readings that are taken together or not at all.
struct RowGroups {
  std::vector<int> of_row;  // per row of the recording: its group, -1 = none
  int count = 0;
};

/// Per group the information (names x names) at the calibration's start. Its other parameters are
/// unknown to within their tolerances, and what the group says of them is no help to another one:
/// the pose of an edge belongs to its own rows.
std::vector<Eigen::MatrixXd> InformationOf(const Calibration& calibration,
                                           const Noise& noise,
                                           const std::vector<std::string>& names,
                                           const RowGroups& groups);

/// Rows A with A'A = information, as few as it has directions.
Eigen::MatrixXd RowsOfInformation(const Eigen::MatrixXd& information);

/// The projector on what no reading of this information shows.
Eigen::MatrixXd UnseenBy(const Eigen::MatrixXd& information);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_INFORMATION_H_
