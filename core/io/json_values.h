// Setting values of result.json. A number that was not computed (NaN, count -1) has no key, so that
// a reader cannot mistake it for a value.
#ifndef DHCAL_CORE_IO_JSON_VALUES_H_
#define DHCAL_CORE_IO_JSON_VALUES_H_

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dhcal {

using Json = nlohmann::ordered_json;

inline void Set(const char* key, double value, Json* object) {
  if (std::isfinite(value)) (*object)[key] = value;
}

inline void SetCount(const char* key, int value, Json* object) {
  if (value >= 0) (*object)[key] = value;
}

inline void SetText(const char* key, const std::string& value, Json* object) {
  if (!value.empty()) (*object)[key] = value;
}

/// All or nothing: an array with holes would put numbers at wrong places.
inline void SetArray(const char* key, const std::vector<double>& values, Json* object) {
  if (values.empty()) return;
  for (const double value : values) {
    if (!std::isfinite(value)) return;
  }
  (*object)[key] = values;
}

}  // namespace dhcal

#endif  // DHCAL_CORE_IO_JSON_VALUES_H_
