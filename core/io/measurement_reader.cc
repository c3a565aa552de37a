#include "core/io/measurement_reader.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/pose_reader.h"
#include "core/io/yaml_map.h"

namespace dhcal {

namespace {

bool ReadKind(YamlMap* map, MeasurementKind* kind) {
  return map->RequireKey("kind") && map->ReadChoice<MeasurementKind>(
                                        "kind",
                                        {{"adjacent_position", MeasurementKind::kAdjacentPosition},
                                         {"position", MeasurementKind::kPosition},
                                         {"pose", MeasurementKind::kPose},
                                         {"distance", MeasurementKind::kDistance}},
                                        kind,
                                        {"straight_edge"});
}

void ReadSigma(YamlMap* map,
               const std::string& stem,
               const UnitSpellings& units,
               std::optional<double>* sigma) {
  double number = -1;
  map->Read(stem, units, &number, Range::Above(0));
  if (number > 0) *sigma = number;
}

void ReadAnchors(const YamlValue& value, std::vector<Anchor>* anchors) {
  YamlMap anchor_map(value);
  const auto entries = anchor_map.AllEntries();
  if (anchor_map.valid() && entries.empty()) value.Error("names no anchor");
  for (const auto& [name, position] : entries) {
    Anchor anchor;
    anchor.name = name;
    YamlMap map(position);
    const std::vector<std::string> keys = Spellings("xyz", LengthUnits());
    if (map.valid() && !map.Has(keys[0]) && !map.Has(keys[1])) {
      position.Error("needs its position: 'xyz_m: [x, y, z]' or 'xyz_mm'");
    }
    ReadVector3(&map, "xyz", &anchor.p_WA);
    anchors->push_back(anchor);
  }
}

/// Settings that only one kind has are refused with the others: they would do nothing.
void CheckKindsOwnKeys(YamlMap* map, MeasurementKind kind, NoiseKind noise) {
  if (kind != MeasurementKind::kPose) {
    if (const auto sigma = map->Find("sigma_rotation", SmallAngleUnits())) {
      sigma->value.Error("applies to 'kind: pose' only; remove it");
    }
  }
  if (kind != MeasurementKind::kDistance) {
    if (const auto anchors = map->Find("anchors")) {
      anchors->Error("applies to 'kind: distance' only; remove it");
    }
  }
  if (kind != MeasurementKind::kAdjacentPosition && noise == NoiseKind::kSharedPose) {
    map->Find("noise")->Error(
        "is 'shared_pose', which applies to 'kind: adjacent_position' only; write 'independent'");
  }
}

}  // namespace

void ReadMeasurement(const YamlValue& value, MeasurementSpec* measurement) {
  YamlMap map(value);
  const bool kind_known = ReadKind(&map, &measurement->kind);
  ReadSigma(&map, "sigma", LengthUnits(), &measurement->sigma);
  map.ReadChoice<NoiseKind>(
      "noise",
      {{"independent", NoiseKind::kIndependent}, {"shared_pose", NoiseKind::kSharedPose}},
      &measurement->noise);
  if (!kind_known) {
    // Which of the other keys are right depends on the kind.
    map.AcceptAllKeys();
    return;
  }
  CheckKindsOwnKeys(&map, measurement->kind, measurement->noise);
  if (measurement->kind == MeasurementKind::kPose) {
    ReadSigma(&map, "sigma_rotation", SmallAngleUnits(), &measurement->sigma_rotation);
  }
  if (measurement->kind == MeasurementKind::kDistance) {
    const std::optional<YamlValue> anchors = map.Require("anchors");
    if (anchors) ReadAnchors(*anchors, &measurement->anchors);
  }
}

}  // namespace dhcal
