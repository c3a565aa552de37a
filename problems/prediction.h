// What a calibration predicts for its readings, and how far that is from what was measured.
#ifndef DHCAL_PROBLEMS_PREDICTION_H_
#define DHCAL_PROBLEMS_PREDICTION_H_

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/model/result.h"
#include "problems/calibration.h"
#include "residuals/reading_rows.h"

namespace dhcal {

/// One reading's coordinates: position [m], then rotation vector [rad] for poses; one distance [m].
struct Comparison {
  Eigen::VectorXd measured;
  Eigen::VectorXd predicted;
  /// Measured minus predicted (the paper's Delta x); rotations as Log(R_measured R_predicted').
  Eigen::VectorXd residual;
};

Comparison Compare(const Calibration& calibration,
                   const Eigen::VectorXd& state,
                   const Reading& reading);

/// The same for all readings of `rows`, tile by tile: index of the reading among them.
void VisitComparisons(const ReadingRows& rows,
                      const Eigen::VectorXd& state,
                      const std::function<void(int, const Comparison&)>& visit);

struct ResidualStatistics {
  double rms = kNotSet;           // [m] per coordinate
  double rms_point = kNotSet;     // [m] 3-D distance, where positions are measured
  double max_point = kNotSet;     // [m]
  double rms_rotation = kNotSet;  // [rad] per component
  int num_lengths = 0;            // coordinates in metres
  int num_rotations = 0;
};

/// Statistics over readings; nothing set when there are none.
ResidualStatistics Statistics(const ReadingRows& rows, const Eigen::VectorXd& state);
ResidualStatistics Statistics(const Calibration& calibration,
                              const Eigen::VectorXd& state,
                              const std::vector<Reading>& readings);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PREDICTION_H_
