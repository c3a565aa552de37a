#include "core/physics/setting.h"

#include <algorithm>
#include <utility>

namespace dhcal {

EffectSetting Number(std::string name, std::string meaning) {
  EffectSetting setting;
  setting.name = std::move(name);
  setting.meaning = std::move(meaning);
  return setting;
}

EffectSetting Whole(std::string name, std::string meaning, int low, int high) {
  EffectSetting setting = Number(std::move(name), std::move(meaning));
  setting.kind = SettingKind::kWhole;
  setting.low = low;
  setting.high = high;
  return setting;
}

EffectSetting Flag(std::string name, std::string meaning) {
  EffectSetting setting = Number(std::move(name), std::move(meaning));
  setting.kind = SettingKind::kFlag;
  return setting;
}

EffectSetting JointNumber(std::string name, std::string meaning) {
  EffectSetting setting = Number(std::move(name), std::move(meaning));
  setting.kind = SettingKind::kJoint;
  return setting;
}

EffectSetting Scanned(EffectSetting setting, SettingScan scan, double scan_factor) {
  setting.scan = scan;
  setting.scan_factor = scan_factor;
  return setting;
}

std::optional<WholeRange> WholeRangeOf(const EffectSetting& setting, int num_joints) {
  switch (setting.kind) {
    case SettingKind::kNumber:
      return std::nullopt;
    case SettingKind::kWhole:
      return WholeRange{setting.low, setting.high};
    case SettingKind::kFlag:
      return WholeRange{0, 1};
    case SettingKind::kJoint:
      return WholeRange{1, std::max(num_joints, 1)};
  }
  return std::nullopt;
}

}  // namespace dhcal
