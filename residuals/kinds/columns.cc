#include "residuals/kinds/columns.h"

#include <fmt/format.h>

namespace dhcal {

std::string NeedsColumns(const MeasurementKind& kind, const std::string& names) {
  return fmt::format("'measurement.kind: {}' needs the columns {}; add them or correct the kind",
                     kind.name,
                     names);
}

std::string MissingColumns(const MeasurementKind& kind, const std::vector<NamedColumns>& columns) {
  std::string all;
  bool present = true;
  for (const NamedColumns& named : columns) {
    all += (all.empty() ? "" : " and ") + named.names;
    present = present && named.values.rows() > 0;
  }
  if (!present) return NeedsColumns(kind, all);
  for (const NamedColumns& named : columns) {
    if (named.values.col(0).array().isNaN().all()) {
      return fmt::format("the columns {} are blank in every row", named.names);
    }
  }
  return "";
}

std::vector<MeasuredCoordinate> PointCoordinates() {
  return {{"x", Unit::kMetre}, {"y", Unit::kMetre}, {"z", Unit::kMetre}};
}

Eigen::Vector3d NormalVector(double sigma, Rng* rng) {
  const double x = rng->Normal(), y = rng->Normal(), z = rng->Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

void SimulatePositions(const std::vector<Eigen::Isometry3d>& X_WQ,
                       double sigma,
                       Rng* rng,
                       Recording* recording) {
  recording->p_WQ.resize(static_cast<Eigen::Index>(X_WQ.size()), 3);
  for (std::size_t k = 0; k < X_WQ.size(); ++k) {
    recording->p_WQ.row(static_cast<Eigen::Index>(k)) =
        X_WQ[k].translation() + NormalVector(sigma, rng);
  }
}

}  // namespace dhcal
