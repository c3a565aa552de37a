#include "problems/formats/problem/robot_file.h"

#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/io/text_file.h"
#include "core/io/yaml_map.h"
#include "core/io/yaml_source.h"
#include "problems/formats/problem/path_resolver.h"
#include "problems/formats/problem/robot_nodes.h"
#include "problems/formats/problem/robot_reader.h"

namespace dhcal {
namespace {

std::vector<std::string> EffectNames(const YAML::Node& root) {
  std::vector<std::string> names;
  const YAML::Node effects = Child(Child(root, "parameters"), "effects");
  if (!effects.IsSequence()) return names;
  for (const YAML::Node& effect : effects) {
    const YAML::Node name = Child(effect, "effect"), joint = Child(effect, "joint");
    if (!name.IsScalar()) continue;
    names.push_back(joint.IsScalar() ? fmt::format("{} of joint {}", name.Scalar(), joint.Scalar())
                                     : name.Scalar());
  }
  return names;
}

}  // namespace

std::optional<RobotFile> ReadRobotFile(const std::string& file,
                                       const std::string& data_dir,
                                       Diagnostics* diagnostics) {
  std::optional<std::string> text = ReadTextFile(file, diagnostics);
  if (!text) return std::nullopt;
  Diagnostics found;
  RobotFile result;
  const YamlSource source(file, std::move(*text), &found);
  if (const std::optional<YAML::Node> root = source.Parse()) {
    try {
      YamlMap map(YamlValue(*root, "", {file, 1, 1}, &source));
      map.AcceptAllKeys();
      if (const auto robot = map.Require("robot")) {
        ReadRobot(
            *robot,
            [&data_dir](const YamlValue& path) { return ResolvePath(path, data_dir); },
            &result.robot,
            &result.urdf);
      }
      result.effects = EffectNames(*root);
    } catch (const YAML::Exception& error) {
      found.Error(source.At(error.mark), fmt::format("this cannot be read ({})", error.msg));
    }
  }
  for (const Diagnostic& message : found.all()) diagnostics->Add(message);
  return found.ok() ? std::optional(std::move(result)) : std::nullopt;
}

std::string RobotFileText(const RobotModel& robot,
                          const std::string& name,
                          const std::vector<std::string>& about) {
  YAML::Node root(YAML::NodeType::Map);
  root["schema"] = "1";
  root["name"] = name;
  root["robot"] = NewRobotNode(robot, YAML::Node());
  YAML::Emitter emitter;
  emitter << root;
  std::string text;
  for (const std::string& line : about) text += "# " + line + "\n";
  return text + emitter.c_str() + "\n";
}

}  // namespace dhcal
