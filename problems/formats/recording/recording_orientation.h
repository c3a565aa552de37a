// Reads a recording's orientations, in whichever form they are written, as quaternions.
#ifndef DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_ORIENTATION_H_
#define DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_ORIENTATION_H_

#include <Eigen/Core>

#include "problems/formats/recording/recording_cells.h"
#include "problems/formats/recording/recording_layout.h"

namespace dhcal {

/// num_rows x 4 (w, x, y, z), normalised; NaN where a row has none, no rows without such columns.
/// Reports quaternions that are not of norm 1 and matrices that are no rotation.
Eigen::MatrixXd ReadOrientations(const RecordingLayout& layout, const CellReader& cells);

/// The rotation of three numbers [rad] in one of the forms of three angles or a rotation vector.
Eigen::Matrix3d RotationOf(RecordingField form, const Eigen::Vector3d& numbers);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RECORDING_RECORDING_ORIENTATION_H_
