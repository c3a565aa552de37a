// The paper's measuring head as plain data: what it looks with, in the tool frame Q.
#ifndef DHCAL_CORE_MODEL_HEAD_H_
#define DHCAL_CORE_MODEL_HEAD_H_

#include <array>
#include <optional>

#include <Eigen/Core>

namespace dhcal {

/// A sensor of a head that looks along a straight line at an edge.
struct HeadSensor {
  Eigen::Vector3d p_QS = Eigen::Vector3d::Zero();   // [m] in the tool frame
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit vector of its sight, in the tool frame
};

/// A camera over a ruled edge and two lasers over a flat one beside it.
struct HeadSpec {
  HeadSensor camera;
  std::array<HeadSensor, 2> lasers;
  double ruler_height = 0;      // [m] of the ruled face above the flat one
  std::optional<double> pitch;  // [m] between rulings; absent = not said
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_HEAD_H_
