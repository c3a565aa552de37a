#include "problems/formats/result/result_reader.h"

#include <cstddef>
#include <optional>

#include <fmt/format.h>

#include "core/io/text_file.h"

namespace dhcal {

void TakeFromResult(const std::string& file,
                    const std::function<void(const nlohmann::json&)>& take,
                    Diagnostics* diagnostics) {
  const std::optional<std::string> text = ReadTextFile(file, diagnostics);
  if (!text) return;
  try {
    take(nlohmann::json::parse(*text));
  } catch (const nlohmann::json::exception& error) {
    diagnostics->Error(
        {file},
        fmt::format("is no result.json of this program ({}); run ceres_dhcal again", error.what()));
  }
}

nlohmann::json DeliveredPart(const nlohmann::json& root) {
  if (root.contains("delivered")) return root.at("delivered");
  const int best = root.value("best_fit", -1);
  return best < 0 ? nlohmann::json() : root.at("fits").at(static_cast<std::size_t>(best));
}

}  // namespace dhcal
