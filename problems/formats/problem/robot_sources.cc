#include "problems/formats/problem/robot_sources.h"

#include <string>
#include <utility>

#include "core/io/yaml_source.h"
#include "problems/formats/exchange/ur_calibration.h"
#include "problems/formats/urdf/urdf_chain.h"
#include "problems/formats/urdf/urdf_tree.h"

namespace dhcal {
namespace {

void RefuseBeside(YamlMap* map, const std::string& key, const std::string& instead) {
  if (const std::optional<YamlValue> value = map->Find(key)) {
    value->Error("stands beside 'robot.urdf', which has " + instead + "; remove one of them");
  }
}

}  // namespace

FixedEnds ReadUrdfRows(YamlMap* map,
                       const YamlValue& file,
                       const PathResolver& resolve_path,
                       RobotModel* robot,
                       std::optional<UrdfSource>* urdf) {
  RefuseBeside(map, "joints", "the joints");
  RefuseBeside(map, "units", "units of its own");
  RefuseBeside(map, "links", "the masses (<inertial>)");
  RefuseBeside(map, "calibration_conf", "all of the geometry");
  UrdfEnds wanted;
  wanted.base_where = wanted.tip_where = file.key_where();
  if (const auto base = map->Find("base_link")) wanted.base_where = base->where();
  if (const auto tip = map->Find("tip_link")) wanted.tip_where = tip->where();
  map->Read("base_link", &wanted.base_link);
  map->Read("tip_link", &wanted.tip_link);
  const std::string path = resolve_path(file);
  if (path.empty()) return {};
  Diagnostics found;
  FixedEnds ends;
  std::optional<UrdfTree> tree = ReadUrdf(path, &found);
  if (const auto chain = tree ? FindUrdfChain(*tree, wanted, &found) : std::nullopt) {
    const RobotModel read = RobotOfUrdf(*tree, *chain, &found);
    if (robot->name.empty()) robot->name = read.name;
    robot->joints = read.joints;
    robot->links = read.links;
    robot->convention = read.convention;
    ends = {read.X_WB, read.X_TQ, true};
    *urdf = UrdfSource{path, std::move(tree->text), chain->base_link, chain->tip_link};
  }
  file.source()->AddAll(found);
  return ends;
}

bool ReadUrCalibrationOf(YamlMap* map, const PathResolver& resolve_path, RobotModel* robot) {
  const std::optional<YamlValue> file = map->Find("calibration_conf");
  if (!file) return false;
  const std::string path = resolve_path(*file);
  if (path.empty()) return true;
  if (robot->convention != DhConvention::kStandard) {
    file->Error("corrects standard rows, but 'robot.convention' is modified");
    return true;
  }
  Diagnostics found;
  const std::optional<UrCalibration> calibration = ReadUrCalibration(path, &found);
  if (calibration) AddUrCalibration(*calibration, {path}, robot, &found);
  file->source()->AddAll(found);
  return true;
}

}  // namespace dhcal
