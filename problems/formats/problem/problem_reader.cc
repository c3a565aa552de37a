#include "problems/formats/problem/problem_reader.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/base/text.h"
#include "core/io/text_file.h"
#include "core/io/yaml_map.h"
#include "core/io/yaml_source.h"
#include "core/io/yaml_value.h"
#include "problems/formats/problem/effects_reader.h"
#include "problems/formats/problem/measurement_reader.h"
#include "problems/formats/problem/parameters_reader.h"
#include "problems/formats/problem/path_resolver.h"
#include "problems/formats/problem/robot_reader.h"
#include "problems/formats/problem/simulation_reader.h"
#include "problems/formats/problem/solver_reader.h"
#include "problems/formats/problem/task_reader.h"

namespace dhcal {

namespace {

constexpr int kSchema = 1;

PathResolver PathsOf(const std::string& data_dir) {
  return [data_dir](const YamlValue& path) { return ResolvePath(path, data_dir); };
}

/// The name also names the result folder.
void ReadName(YamlMap* map, ProblemSpec* spec) {
  spec->name = std::filesystem::path(spec->file).stem().string();
  const std::optional<YamlValue> value = map->Find("name");
  if (!value) return;
  const std::optional<std::string> name = value->Text();
  if (!name) return;
  const bool has_control = std::any_of(
      name->begin(), name->end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (has_control || name->find_first_of("/\\") != std::string::npos || name->front() == '.') {
    value->Error(
        fmt::format("is '{}', but the result folder is named after it: write no slashes, "
                    "no control characters and no leading dot",
                    Printable(*name)));
    return;
  }
  spec->name = *name;
}

void CheckSchema(YamlMap* map) {
  const std::optional<YamlValue> value = map->Require("schema");
  if (!value) return;
  if (value->node().IsScalar() && value->node().Scalar() == std::to_string(kSchema)) return;
  value->Error(fmt::format("is {}, but this version reads schema {} only; write 'schema: {}'",
                           value->Describe(),
                           kSchema,
                           kSchema));
}

/// `columns: {q1_rad: shoulder_pan_joint}`, checked when the recording is read.
void ReadColumns(const YamlValue& value, std::vector<ColumnAlias>* columns) {
  YamlMap map(value);
  for (const auto& [ours, theirs] : map.AllEntries()) {
    const std::optional<std::string> name = theirs.Text();
    if (name) columns->push_back({ours, *name, theirs.key_where(), theirs.where()});
  }
}

/// Exactly one of `recording` and `simulate`.
void ReadSourceOfRows(YamlMap* map, const std::string& data_dir, ProblemSpec* spec) {
  const std::optional<YamlValue> recording = map->Find("recording");
  const std::optional<YamlValue> simulate = map->Find("simulate");
  const PathResolver resolve = PathsOf(data_dir);
  if (recording) {
    spec->recording = resolve(*recording);
    spec->recording_where = recording->where();
  }
  if (simulate) {
    spec->simulate.emplace();
    ReadSimulation(*simulate, spec->robot, spec->measurement.kind, resolve, &*spec->simulate);
  }
  if (const std::optional<YamlValue> columns = map->Find("columns")) {
    ReadColumns(*columns, &spec->columns);
    if (simulate)
      columns->Error("names columns of a 'recording', which this file has not; remove it");
  }
  if (recording && simulate) {
    recording->Error("stands beside 'simulate'; keep one of them");
  } else if (!map->Has("recording") && !map->Has("simulate")) {
    map->value().source()->Error(
        map->value().key_where(),
        "the file has neither 'recording' (a CSV file) nor 'simulate'; add one of them");
  }
}

void CheckOneBasePerEdge(const YamlValue& measurement, const RobotModel& robot) {
  if (!robot.base_per_edge || !robot.base_per_run) return;
  measurement.Error(
      "reads along edges, each with a base pose of its own; remove 'per_run' from "
      "'robot.base' (an edge that was moved between runs has another name in each)");
}

void ReadProblem(const YamlValue& root, const std::string& data_dir, ProblemSpec* spec) {
  YamlMap map(root);
  if (!map.valid()) return;
  CheckSchema(&map);
  ReadName(&map, spec);
  if (const auto robot = map.Require("robot")) {
    ReadRobot(*robot, PathsOf(data_dir), &spec->robot, &spec->urdf);
  }
  if (const auto measurement = map.Require("measurement")) {
    ReadMeasurement(*measurement, &spec->measurement);
    spec->robot.anchors = spec->measurement.anchors;
    spec->robot.edges = spec->measurement.edges;
    spec->robot.base_per_edge = spec->measurement.kind.edges;
    if (spec->measurement.kind.edges) spec->robot.head = spec->measurement.head;
    CheckOneBasePerEdge(*measurement, spec->robot);
  }
  spec->parameters.where = root.key_where();
  // An instrument beside the robot, or an edge, stands anywhere and looks at, or is seen from,
  // something put on by hand.
  if (!spec->measurement.kind.pairs || spec->measurement.kind.edges)
    spec->parameters.estimate = {"complete"};
  if (const auto parameters = map.Find("parameters")) {
    spec->parameters.where = parameters->key_where();
    ReadParameters(*parameters, spec->robot, &spec->parameters);
  }
  if (const auto solver = map.Find("solver")) ReadSolver(*solver, &spec->solver);
  if (const auto diagnosis = map.Find("diagnosis")) ReadDiagnosis(*diagnosis, &spec->diagnosis);
  if (const auto task = map.Find("task")) {
    spec->task.emplace();
    const PathResolver resolve = [&](const YamlValue& path) { return ResolvePath(path, data_dir); };
    ReadTask(*task, spec->robot, resolve, &*spec->task);
  }
  ReadSourceOfRows(&map, data_dir, spec);
}

/// Adds the messages of `from` in the order of their places.
void AddSorted(const Diagnostics& from, Diagnostics* to) {
  std::vector<Diagnostic> all = from.all();
  std::stable_sort(all.begin(), all.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  for (Diagnostic& diagnostic : all) to->Add(std::move(diagnostic));
}

}  // namespace

std::optional<ProblemSpec> ReadProblemFile(const std::string& file,
                                           const std::string& data_dir,
                                           Diagnostics* diagnostics) {
  std::optional<std::string> content = ReadTextFile(file, diagnostics);
  if (!content) return std::nullopt;
  Diagnostics found;
  ProblemSpec spec;
  spec.file = file;
  const YamlSource source(file, std::move(*content), &found);
  if (const std::optional<YAML::Node> root = source.Parse()) {
    try {
      ReadProblem(YamlValue(*root, "", {file, 1, 1}, &source), data_dir, &spec);
    } catch (const YAML::Exception& error) {
      found.Error(source.At(error.mark), fmt::format("this cannot be read ({})", error.msg));
    }
  }
  AddSorted(found, diagnostics);
  return found.ok() ? std::optional(std::move(spec)) : std::nullopt;
}

}  // namespace dhcal
