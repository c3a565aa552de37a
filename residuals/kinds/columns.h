// What kinds share of a recording's columns: their names, blanks, and readings written with noise.
#ifndef DHCAL_RESIDUALS_KINDS_COLUMNS_H_
#define DHCAL_RESIDUALS_KINDS_COLUMNS_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/rng.h"
#include "core/model/measurement_kind.h"
#include "core/model/recording.h"

namespace dhcal {

constexpr char kPositionColumns[] = "x_mm, y_mm, z_mm (or _m)";

/// Columns whose names a user knows, and their cells.
struct NamedColumns {
  std::string names;              // "x_mm, y_mm, z_mm (or _m)"
  const Eigen::MatrixXd& values;  // num_rows x k; zero rows = absent
};

/// "'measurement.kind: NAME' needs the columns ...", "the columns ... are blank in every row", or
/// "" where all of `columns` are there and filled somewhere.
std::string MissingColumns(const MeasurementKind& kind, const std::vector<NamedColumns>& columns);

/// "'measurement.kind: NAME' needs the columns NAMES; add them or correct the kind".
std::string NeedsColumns(const MeasurementKind& kind, const std::string& names);

/// True if the column is there and the row's cells are not blank.
inline bool Present(const Eigen::MatrixXd& column, int row_idx) {
  return column.rows() > 0 && column.row(row_idx).allFinite();
}

/// "x", "y", "z" in metres.
std::vector<MeasuredCoordinate> PointCoordinates();

/// Independent normal errors of three components.
Eigen::Vector3d NormalVector(double sigma, Rng* rng);

/// Positions of the measured point with noise, as x, y, z.
void SimulatePositions(const std::vector<Eigen::Isometry3d>& X_WQ,
                       double sigma,
                       Rng* rng,
                       Recording* recording);

}  // namespace dhcal

#endif  // DHCAL_RESIDUALS_KINDS_COLUMNS_H_
