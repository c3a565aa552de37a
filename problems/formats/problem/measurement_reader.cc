#include "problems/formats/problem/measurement_reader.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/yaml_map.h"
#include "problems/formats/problem/head_reader.h"
#include "problems/formats/problem/pose_reader.h"
#include "residuals/registry.h"

namespace dhcal {

namespace {

bool ReadKind(YamlMap* map, MeasurementKind* kind) {
  std::vector<std::pair<std::string, MeasurementKind>> kinds;
  for (const MeasurementType* const type : AllMeasurementTypes()) {
    kinds.emplace_back(type->Describe().name, type->Describe());
  }
  return map->RequireKey("kind") && map->ReadChoice<MeasurementKind>("kind", kinds, kind);
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

/// "'kind: pose'", "'kind: position' or 'kind: pose'": the kinds of which something holds.
std::string KindsThat(const std::function<bool(const MeasurementKind&)>& holds) {
  std::string names;
  for (const MeasurementType* const type : AllMeasurementTypes()) {
    const MeasurementKind kind = type->Describe();
    if (holds(kind)) names += (names.empty() ? "'kind: " : " or 'kind: ") + kind.name + "'";
  }
  return names;
}

/// Settings that only some kinds have are refused with the others: they would do nothing.
void CheckKindsOwnKeys(YamlMap* map, const MeasurementSpec& measurement) {
  const MeasurementKind& kind = measurement.kind;
  const auto refuse = [](const YamlValue& value, const auto& holds) {
    value.Error(fmt::format("applies to {} only; remove it", KindsThat(holds)));
  };
  const auto rotations = [](const MeasurementKind& k) { return k.sees_orientation(); };
  const auto anchors = [](const MeasurementKind& k) { return k.anchors; };
  const auto edges = [](const MeasurementKind& k) { return k.edges; };
  // A ruler has no position that a first pose could be known by.
  const auto anchored = [](const MeasurementKind& k) { return k.pairs && !k.edges; };
  const auto shared = [](const MeasurementKind& k) { return k.shared_noise; };
  if (!rotations(kind)) {
    if (const auto sigma = map->Find("sigma_rotation", SmallAngleUnits())) {
      refuse(sigma->value, rotations);
    }
  }
  if (!anchors(kind)) {
    if (const auto value = map->Find("anchors")) refuse(*value, anchors);
  }
  if (!anchored(kind)) {
    if (const auto value = map->Find("anchored")) refuse(*value, anchored);
  }
  if (!edges(kind)) {
    for (const char* const key : {"head", "edges"}) {
      if (const auto value = map->Find(key)) refuse(*value, edges);
    }
  }
  if (!shared(kind) && measurement.noise == NoiseKind::kSharedPose) {
    map->Find("noise")->Error(fmt::format(
        "is 'shared_pose', which applies to {} only; write 'independent'", KindsThat(shared)));
  }
}

/// Which poses of a series are measured by themselves, too.
enum class Anchored { kNone, kFirst };

}  // namespace

void ReadMeasurement(const YamlValue& value, MeasurementSpec* measurement) {
  YamlMap map(value);
  const bool kind_known = ReadKind(&map, &measurement->kind);
  measurement->where = value.key_where();
  ReadSigma(&map, "sigma", LengthUnits(), &measurement->sigma);
  // What a head reads at a pose enters both of its differences.
  if (measurement->kind.edges) measurement->noise = NoiseKind::kSharedPose;
  map.ReadChoice<NoiseKind>(
      "noise",
      {{"independent", NoiseKind::kIndependent}, {"shared_pose", NoiseKind::kSharedPose}},
      &measurement->noise);
  if (!kind_known) {
    // Which of the other keys are right depends on the kind.
    map.AcceptAllKeys();
    return;
  }
  CheckKindsOwnKeys(&map, *measurement);
  if (measurement->kind.pairs && !measurement->kind.edges) {
    Anchored anchored = Anchored::kNone;
    map.ReadChoice<Anchored>(
        "anchored", {{"none", Anchored::kNone}, {"first", Anchored::kFirst}}, &anchored);
    measurement->anchored = anchored == Anchored::kFirst;
  }
  if (measurement->kind.sees_orientation()) {
    ReadSigma(&map, "sigma_rotation", SmallAngleUnits(), &measurement->sigma_rotation);
  }
  if (measurement->kind.anchors) {
    const std::optional<YamlValue> anchors = map.Require("anchors");
    if (anchors) ReadAnchors(*anchors, &measurement->anchors);
  }
  if (measurement->kind.edges) {
    if (const auto head = map.Require("head")) ReadHead(*head, measurement);
    if (const auto edges = map.Find("edges")) ReadEdges(*edges, &measurement->edges);
  }
}

}  // namespace dhcal
