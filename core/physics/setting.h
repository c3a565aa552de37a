// Settings of an effect: the numbers that fix its shape and are not estimated.
#ifndef DHCAL_CORE_PHYSICS_SETTING_H_
#define DHCAL_CORE_PHYSICS_SETTING_H_

#include <optional>
#include <string>

namespace dhcal {

enum class SettingKind {
  kNumber,  // any number
  kWhole,   // counts something
  kFlag,    // 0 = off, 1 = on
  kJoint    // a joint, from 1
};

/// How a diagnosis looks for a setting's best value beside the candidates' own.
enum class SettingScan {
  kNone,
  kOrders,             // lines of the spectrum of the joint's angle
  kInstants,           // each instant between two rows
  kTimeConstants,      // on a log scale around the duration; 0 = a steady drift, left as it is
  kBetweenCandidates,  // on a log scale, `scan_factor` to either side
};

struct EffectSetting {
  std::string name;     // "order"
  std::string meaning;  // "N, default 1"
  SettingKind kind = SettingKind::kNumber;
  int low = 0, high = 0;  // kWhole
  SettingScan scan = SettingScan::kNone;
  double scan_factor = 1;

  /// True where values differ only as points of one scan: with any of them it is one hypothesis.
  bool is_refined() const { return scan != SettingScan::kNone && scan != SettingScan::kOrders; }
};

EffectSetting Number(std::string name, std::string meaning);
EffectSetting Whole(std::string name, std::string meaning, int low, int high);
EffectSetting Flag(std::string name, std::string meaning);
EffectSetting JointNumber(std::string name, std::string meaning);
/// The same setting, scanned.
EffectSetting Scanned(EffectSetting setting, SettingScan scan, double scan_factor = 1);

struct WholeRange {
  int low = 0;
  int high = 0;
};

/// What a setting may be where it is a whole number; nothing where it may be any number.
std::optional<WholeRange> WholeRangeOf(const EffectSetting& setting, int num_joints);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_SETTING_H_
