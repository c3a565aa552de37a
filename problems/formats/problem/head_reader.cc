#include "problems/formats/problem/head_reader.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/text.h"
#include "problems/formats/problem/pose_reader.h"

namespace dhcal {
namespace {

constexpr double kShortestAxis = 1e-6;  // an axis by direction only, in no unit

/// In the order of a reading's coordinates.
constexpr std::array<const char*, 3> kSensors = {"camera", "laser1", "laser2"};

/// A sensor's keys; its own noise [m], where it is given.
std::optional<double> ReadSensor(const YamlValue& value, HeadSensor* sensor) {
  YamlMap map(value);
  if (map.valid() && !map.Find("xyz", LengthUnits())) {
    value.Error("needs its place on the head: 'xyz_mm: [x, y, z]' or 'xyz_m', in the tool frame");
  }
  ReadVector3(&map, "xyz", &sensor->p_QS);
  Eigen::VectorXd axis = sensor->axis;
  map.Read("axis", {{"", 1.0}}, 3, &axis);
  if (axis.norm() < kShortestAxis) {
    map.Find("axis")->Error(
        "has no direction; write the line of sight in the tool frame, such as "
        "[0, 0, 1]");
  } else {
    sensor->axis = axis.normalized();
  }
  double sigma = 0;
  map.Read("sigma", LengthUnits(), &sigma, Range::Above(0));
  return sigma > 0 ? std::optional(sigma) : std::nullopt;
}

bool HasPose(YamlMap* map) {
  const bool place = map->Find("xyz", LengthUnits()).has_value();
  return map->Find("rpy", AngleUnits()).has_value() || place;
}

void AddEdge(const YamlValue& where, const Edge& edge, std::vector<Edge>* edges) {
  const bool twice = std::any_of(
      edges->begin(), edges->end(), [&](const Edge& known) { return known.name == edge.name; });
  if (twice) where.Error(fmt::format("names '{}' twice", Printable(edge.name)));
  edges->push_back(edge);
}

}  // namespace

void ReadHead(const YamlValue& value, MeasurementSpec* measurement) {
  YamlMap map(value);
  HeadSpec& head = measurement->head;
  const std::array<HeadSensor*, 3> sensors = {&head.camera, &head.lasers[0], &head.lasers[1]};
  std::array<std::optional<double>, 3> sigmas;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const std::optional<YamlValue> sensor = map.Require(kSensors[k]);
    if (sensor) sigmas[k] = ReadSensor(*sensor, sensors[k]);
  }
  map.Read("ruler_height", LengthUnits(), &head.ruler_height);
  double pitch = 0;
  map.Read("pitch", LengthUnits(), &pitch, Range::Above(0));
  if (pitch > 0) head.pitch = pitch;

  const auto given = std::count_if(
      sigmas.begin(), sigmas.end(), [](const auto& sigma) { return sigma.has_value(); });
  if (given == 0) return;
  if (!measurement->sigma && given < 3) {
    value.Error(
        "gives the noise of some sensors only; give 'sigma_mm' to all three, or "
        "'measurement.sigma_mm' for the others");
    return;
  }
  if (!measurement->sigma) measurement->sigma = sigmas[0];
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    measurement->kind.coordinates[k].noise =
        sigmas[k].value_or(*measurement->sigma) / *measurement->sigma;
  }
}

void ReadEdges(const YamlValue& value, std::vector<Edge>* edges) {
  if (value.IsList()) {
    const std::optional<std::vector<YamlValue>> names = value.List();
    for (const YamlValue& item : *names) {
      const std::optional<std::string> name = item.Text();
      if (name) AddEdge(item, {*name, std::nullopt}, edges);
    }
  } else {
    YamlMap map(value);
    for (const auto& [name, pose_value] : map.AllEntries()) {
      YamlMap pose(pose_value);
      Edge edge{name, std::nullopt};
      if (HasPose(&pose)) edge.X_WE = ReadPoseKeys(&pose);
      AddEdge(pose_value, edge, edges);
    }
    if (!map.valid()) return;
  }
  if (edges->empty()) value.Error("names no edge; name them, or remove the key");
}

}  // namespace dhcal
