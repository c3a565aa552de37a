#include "tools/compare/read_result.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "problems/formats/result/result_reader.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

/// A number that may be missing.
double Number(const Json& part, const char* key) { return part.value(key, kNotSet); }

/// In 3-D where there is such a figure.
double Told(const Json& part, const char* of_points, const char* of_coordinates) {
  return part.contains(of_points) ? Number(part, of_points) : Number(part, of_coordinates);
}

std::string EffectWords(const Json& effect) {
  const auto name = effect.at("effect").get<std::string>();
  return effect.contains("joint") ? fmt::format("{}, joint {}", name, effect.at("joint").get<int>())
                                  : name;
}

void ReadParameters(const Json& part, ReadResult* result) {
  for (const Json& entry : part.at("parameters")) {
    const auto verdict = entry.at("verdict").get<std::string>();
    if (verdict == "fixed") continue;
    result->parameters.push_back({entry.at("name").get<std::string>(),
                                  entry.at("unit").get<std::string>(),
                                  entry.at("value").get<double>(),
                                  Number(entry, "sigma"),
                                  verdict == "identified" || verdict == "weak"});
  }
}

void ReadUnseen(const Json& root, const Json& told, ReadResult* result) {
  if (!root.contains("validation")) return;
  const Json& validation = root.at("validation");
  result->unseen_method = validation.value("method", "");
  result->unseen_rows = validation.value("rows", 0);
  result->unseen = Told(told, "rms_point_test_m", "rms_test_m");
  result->unseen_max = Number(told, "max_point_test_m");
}

ReadResult FromJson(const Json& root) {
  ReadResult result;
  result.problem = root.at("problem").get<std::string>();
  result.kind = root.at("kind").get<std::string>();
  result.rows = root.at("rows").get<int>();
  result.noise = Number(root, "noise_sigma_m");
  const bool delivered = root.contains("delivered");
  const Json model = DeliveredPart(root);
  result.in_space = model.contains("rms_point_m");
  result.fitted = Told(model, "rms_point_m", "rms_m");
  result.fitted_max = Number(model, "max_point_m");
  result.intervals_hold = (delivered ? model : root).value("intervals", "") == "hold";
  if (result.in_space) result.noise *= std::sqrt(3.0);
  const Json& baseline = root.at("baseline");
  const char* const before =
      baseline.contains("base_and_tool_only") ? "base_and_tool_only" : "nominal";
  result.before = Told(baseline.at(before), "rms_point_m", "rms_m");
  ReadUnseen(root, delivered ? model : root.value("validation", Json::object()), &result);
  if (root.contains("diagnosis")) {
    result.diagnosis = root.at("diagnosis").at("verdict").get<std::string>();
  }
  for (const Json& effect : model.value("effects", Json::array())) {
    result.effects.push_back(EffectWords(effect));
  }
  ReadParameters(model, &result);
  return result;
}

}  // namespace

std::optional<ReadResult> ReadResultFolder(const std::string& folder, Diagnostics* diagnostics) {
  const std::string file = (std::filesystem::path(folder) / "result.json").string();
  std::optional<ReadResult> result;
  TakeFromResult(
      file,
      [&](const Json& root) {
        if (root.value("best_fit", -1) < 0) {
          diagnostics->Error({file},
                             "holds no usable result, so there is nothing to compare; report.txt "
                             "beside it says why");
          return;
        }
        result = FromJson(root);
        result->folder = folder;
      },
      diagnostics);
  return result;
}

}  // namespace dhcal
