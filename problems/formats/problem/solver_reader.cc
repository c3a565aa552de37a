#include "problems/formats/problem/solver_reader.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/io/yaml_map.h"

namespace dhcal {

namespace {

const std::vector<std::pair<std::string, SolverMethod>> kMethods = {
    {"svd_gauss_newton", SolverMethod::kSvdGaussNewton},
    {"levenberg_marquardt", SolverMethod::kLevenbergMarquardt},
    {"both", SolverMethod::kBoth}};

void ReadTruncation(YamlMap* map, SolverSpec* solver) {
  const std::optional<YamlValue> value = map->Find("singular_value_tolerance");
  if (!value) return;
  const std::string text = value->node().IsScalar() ? value->node().Scalar() : "";
  if (ParseTruncation(text, solver)) return;
  value->Error(
      fmt::format("is {}, but 'noise', 'paper' or a number above 0 and below 1 is "
                  "expected",
                  value->Describe()));
}

void ReadLoss(YamlMap* map, SolverSpec* solver) {
  const bool written = map->Has("loss");
  const bool read = map->ReadChoice<LossKind>("loss",
                                              {{"none", LossKind::kNone},
                                               {"huber", LossKind::kHuber},
                                               {"cauchy", LossKind::kCauchy},
                                               {"tukey", LossKind::kTukey}},
                                              &solver->loss);
  map->Read("loss_scale", &solver->loss_scale, Range::Above(0));
  if (solver->loss != LossKind::kNone || (written && !read)) return;
  if (const std::optional<YamlValue> scale = map->Find("loss_scale")) {
    scale->Error("scales a loss, but none is chosen; write 'loss: huber', 'cauchy' or 'tukey'");
  }
}

}  // namespace

bool ParseTruncation(std::string_view text, SolverSpec* solver) {
  const std::optional<double> number = ParseDouble(text);
  if (text == "noise") {
    solver->rule = TruncationRule::kNoise;
  } else if (text == "paper") {
    solver->rule = TruncationRule::kPaper;
  } else if (number && Range::Inside(0, 1).Contains(*number)) {
    solver->rule = TruncationRule::kRelative;
    solver->relative_tolerance = *number;
  } else {
    return false;
  }
  return true;
}

bool ParseSolverMethod(std::string_view text, SolverSpec* solver) {
  for (const auto& [name, method] : kMethods) {
    if (name != text) continue;
    solver->method = method;
    return true;
  }
  return false;
}

void ReadSolver(const YamlValue& value, SolverSpec* solver) {
  YamlMap map(value);
  map.ReadChoice<SolverMethod>("method", kMethods, &solver->method);
  map.Read("kappa", &solver->kappa, Range::AtLeast(0));
  ReadTruncation(&map, solver);
  map.Read("max_iterations", &solver->max_iterations, 1, 10000);
  ReadLoss(&map, solver);
}

}  // namespace dhcal
