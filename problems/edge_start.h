// Where the fit starts along straight edges: the pose of the base in each edge's frame.
#ifndef DHCAL_PROBLEMS_EDGE_START_H_
#define DHCAL_PROBLEMS_EDGE_START_H_

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/model/problem_spec.h"
#include "problems/calibration.h"

namespace dhcal {

/// What a head read at poses of one edge.
struct EdgeRows {
  std::vector<Eigen::Isometry3d> X_BQ;   // of the nominal robot
  std::vector<Eigen::Vector3d> numbers;  // ruler, height1, height2 [m], absolute as read
};

/// Pose X_BE of an edge from readings along it: the plane that the lasers' spots lie in, and in it
/// the direction in which the camera's readings grow. x is 0 where the ruler is, y is 0 in the mean
/// of the camera's spots. Where all spots lie on one line, the face is taken at right angles to the
/// lasers' sights. Nothing where the head did not move along the edge.
std::optional<Eigen::Isometry3d> AlignEdge(const HeadSpec& head, const EdgeRows& rows);

/// Moves the base of every edge whose pose the file does not give, or leaves free and without
/// priors, to its alignment with the readings.
void AlignEdges(Calibration* calibration);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_EDGE_START_H_
