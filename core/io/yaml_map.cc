#include "core/io/yaml_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"

namespace dhcal {

const UnitSpellings& LengthUnits() {
  static const UnitSpellings units = {{"_m", 1.0}, {"_mm", kMillimetre}};
  return units;
}

const UnitSpellings& AngleUnits() {
  static const UnitSpellings units = {{"_deg", kDegree}, {"_rad", 1.0}};
  return units;
}

const UnitSpellings& SmallAngleUnits() {
  static const UnitSpellings units = {{"_rad", 1.0}, {"_deg", kDegree}, {"_mrad", kMilliradian}};
  return units;
}

std::vector<std::string> Spellings(const std::string& stem, const UnitSpellings& units) {
  std::vector<std::string> keys;
  for (const UnitSpelling& unit : units) keys.push_back(stem + unit.suffix);
  return keys;
}

YamlMap::YamlMap(const YamlValue& value) : value_(value) {
  if (!value.IsMap()) {
    value.Error("must be a map of keys (lines 'key: value')");
    return;
  }
  for (const auto& pair : value.node()) AddEntry(pair.first, pair.second);
}

YamlMap::~YamlMap() { ReportUnknownKeys(); }

void YamlMap::AddEntry(const YAML::Node& key, const YAML::Node& value) {
  const YamlSource* const source = value_.source();
  const SourceLocation where = source->At(key.Mark());
  if (!key.IsScalar() || key.Scalar().empty()) {
    source->Error(where, "a key must be a word, as in 'key: value'");
    return;
  }
  const std::string& name = key.Scalar();
  const Entry* const first = FindEntry(name);
  if (first != nullptr) {
    source->Error(
        where,
        fmt::format("the key '{}' stands a second time, first in line {}; keep one of them",
                    Printable(name),
                    first->where.line));
  }
  const std::string path = value_.name().empty() ? name : value_.name() + "." + name;
  entries_.push_back({name, where, YamlValue(value, path, where, source), first != nullptr});
}

const YamlMap::Entry* YamlMap::FindEntry(const std::string& key) const {
  const auto found = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<YamlValue> YamlMap::ValueOf(const Entry& entry) const {
  if (entry.value.node().IsNull()) {
    value_.source()->Error(
        entry.where,
        fmt::format("'{}' has no value; write one or remove the key", entry.value.name()));
    return std::nullopt;
  }
  return entry.value;
}

bool YamlMap::Has(const std::string& key) {
  known_keys_.push_back(key);
  return FindEntry(key) != nullptr;
}

std::optional<YamlValue> YamlMap::Find(const std::string& key) {
  known_keys_.push_back(key);
  const Entry* const entry = FindEntry(key);
  return entry == nullptr ? std::nullopt : ValueOf(*entry);
}

bool YamlMap::RequireKey(const std::string& key) {
  if (!valid()) return false;
  if (Has(key)) return true;
  value_.source()->Error(value_.key_where(),
                         fmt::format("{} lacks the key '{}'", value_.QuotedName(), key));
  return false;
}

std::optional<YamlValue> YamlMap::Require(const std::string& key) {
  return RequireKey(key) ? Find(key) : std::nullopt;
}

std::optional<UnitValue> YamlMap::Find(const std::string& stem, const UnitSpellings& units) {
  const Entry* found = nullptr;
  double to_si = 1;
  for (const UnitSpelling& unit : units) {
    known_keys_.push_back(stem + unit.suffix);
    const Entry* const entry = FindEntry(known_keys_.back());
    if (entry == nullptr) continue;
    if (found != nullptr) {
      ReportSameQuantity(*std::min(found, entry), *std::max(found, entry));
      return std::nullopt;
    }
    found = entry;
    to_si = unit.to_si;
  }
  if (found == nullptr) return std::nullopt;
  const std::optional<YamlValue> value = ValueOf(*found);
  return value ? std::optional(UnitValue{*value, to_si}) : std::nullopt;
}

void YamlMap::ReportSameQuantity(const Entry& first, const Entry& second) const {
  value_.source()->Error(
      second.where,
      fmt::format(
          "'{}' and '{}' give the same quantity twice; keep one of them", first.key, second.key));
}

void YamlMap::Read(const std::string& key, double* number, const Range& range) {
  Read(key, {{"", 1.0}}, number, range);
}

void YamlMap::Read(const std::string& key, int* number, int low, int high) {
  const std::optional<YamlValue> found = Find(key);
  if (!found) return;
  if (const std::optional<int> read = found->Integer(low, high)) *number = *read;
}

void YamlMap::Read(const std::string& key, bool* flag) {
  const std::optional<YamlValue> found = Find(key);
  if (!found) return;
  if (const std::optional<bool> read = found->Boolean()) *flag = *read;
}

void YamlMap::Read(const std::string& key, std::string* text) {
  const std::optional<YamlValue> found = Find(key);
  if (!found) return;
  if (const std::optional<std::string> read = found->Text()) *text = *read;
}

void YamlMap::Read(const std::string& stem,
                   const UnitSpellings& units,
                   double* number,
                   const Range& range) {
  const std::optional<UnitValue> found = Find(stem, units);
  if (!found) return;
  if (const std::optional<double> read = found->value.Number(range)) *number = *read * found->to_si;
}

void YamlMap::Read(const std::string& stem,
                   const UnitSpellings& units,
                   int length,
                   Eigen::VectorXd* numbers) {
  const std::optional<UnitValue> found = Find(stem, units);
  if (!found) return;
  const std::optional<Eigen::VectorXd> read = found->value.Numbers(length);
  if (read) *numbers = *read * found->to_si;
}

int YamlMap::ChooseWord(const YamlValue& value, const std::vector<std::string>& words) {
  const std::optional<std::string> text = value.Text();
  if (!text) return -1;
  const auto found = std::find(words.begin(), words.end(), *text);
  if (found != words.end()) return static_cast<int>(found - words.begin());
  const std::string nearest = NearestName(*text, words);
  value.Error(fmt::format("is '{}', but {} is expected{}",
                          Printable(*text),
                          QuotedList(words),
                          nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  return -1;
}

std::vector<std::pair<std::string, YamlValue>> YamlMap::AllEntries() {
  any_key_ = true;
  std::vector<std::pair<std::string, YamlValue>> entries;
  for (const Entry& entry : entries_) {
    if (entry.duplicate) continue;
    if (const std::optional<YamlValue> value = ValueOf(entry)) {
      entries.emplace_back(entry.key, *value);
    }
  }
  return entries;
}

std::string YamlMap::UnknownKeyMessage(const std::string& key) const {
  std::string message = fmt::format("unknown key '{}' in {}{}",
                                    Printable(key),
                                    value_.QuotedName(),
                                    remark_.empty() ? "" : " " + remark_);
  if (key == "<<") return message + ": merge keys are not supported; write the keys out";
  if (ParseDouble(key)) {
    return message + ": a number stands where a key is expected; write decimals with a point";
  }
  const std::string nearest = NearestName(key, known_keys_);
  if (!nearest.empty()) return message + "; did you mean '" + nearest + "'?";
  std::vector<std::string> valid = known_keys_;
  std::sort(valid.begin(), valid.end());
  valid.erase(std::unique(valid.begin(), valid.end()), valid.end());
  return message + "; valid keys: " + QuotedList(valid, "and");
}

void YamlMap::ReportUnknownKeys() const {
  if (any_key_) return;
  for (const Entry& entry : entries_) {
    if (entry.duplicate) continue;
    if (std::find(known_keys_.begin(), known_keys_.end(), entry.key) != known_keys_.end()) continue;
    value_.source()->Error(entry.where, UnknownKeyMessage(entry.key));
  }
}

}  // namespace dhcal
