// What a kind of measurement says of itself, as plain data: reports, analysis and readers ask this
// instead of knowing kinds by name. The registry of kinds: residuals/registry.h.
#ifndef DHCAL_CORE_MODEL_MEASUREMENT_KIND_H_
#define DHCAL_CORE_MODEL_MEASUREMENT_KIND_H_

#include <string>
#include <vector>

#include "core/model/parameter.h"

namespace dhcal {

/// One number of a reading. Metres are whitened by the reading's sigma, radians by the sigma of
/// rotations.
struct MeasuredCoordinate {
  std::string name;  // "x", "rx", "distance"
  Unit unit = Unit::kMetre;
  /// Its standard deviation, in those of the reading: sensors of a head may differ.
  double noise = 1;
};

/// A freedom of the base that no reading of a kind shows.
struct HiddenFreedom {
  int base_component = 0;  // 0..5: x y z rx ry rz
  std::string why;         // follows the parameter's name
};

struct MeasurementKind {
  std::string name;                             // as the problem file has it: "adjacent_position"
  std::string sentence;                         // "position of the tool point"
  std::string noun;                             // what is predicted: "position"
  std::vector<MeasuredCoordinate> coordinates;  // those in metres first
  /// A reading compares a row with the row before it of the same run and target.
  bool pairs = false;
  /// What moves all poses alike shows: false for differences.
  bool sees_offset = true;
  /// Needs `anchors` in the problem file and the column `anchor`.
  bool anchors = false;
  /// Reads along straight edges: needs `head` in the problem file and the column `edge`, and every
  /// edge is a measurement frame of its own.
  bool edges = false;
  /// The coordinates are read at different points of the tool: they are no components of one 3-D
  /// error, and turns of the tool about Q show.
  bool several_points = false;
  std::vector<HiddenFreedom> hidden;
  /// May the readings of a pair share a pose's error (noise: shared_pose)?
  bool shared_noise = false;

  int num_coordinates() const { return static_cast<int>(coordinates.size()); }
  /// Coordinates in metres; the rest are rotations.
  int num_lengths() const {
    int count = 0;
    for (const MeasuredCoordinate& c : coordinates) count += c.unit == Unit::kMetre ? 1 : 0;
    return count;
  }
  /// The tool's orientation is a coordinate.
  bool sees_orientation() const { return num_lengths() < num_coordinates(); }
  /// Turns of the tool about the measured point show.
  bool turns_show() const { return sees_orientation() || several_points; }
  /// The lengths of one reading are the components of a 3-D error.
  bool is_point() const { return num_lengths() == 3 && !several_points; }
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_MEASUREMENT_KIND_H_
