// Reading result.json again (FORMATS.md, section 3).
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_READER_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_READER_H_

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/diagnostics.h"

namespace dhcal {

/// Lets `take` take what it needs from the root of a result.json. Adds an error where the file
/// cannot be read, is no result.json or lacks what `take` asks for by at().
void TakeFromResult(const std::string& file,
                    const std::function<void(const nlohmann::json&)>& take,
                    Diagnostics* diagnostics);

/// The part that describes what calibrated.yaml holds: geometry and effects found, or else the best
/// fit; null where there is neither.
nlohmann::json DeliveredPart(const nlohmann::json& root);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_READER_H_
