#include "core/physics/step.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace dhcal {
namespace {

constexpr int kInstants = 12;

/// Instant of a request on the context's clock.
double Instant(const EffectRequest& request) {
  return request.setting("at_s", request.setting("at_row", -1));
}

}  // namespace

const char* StepSetting(const PhysicsContext& c) { return c.has_one_clock() ? "at_s" : "at_row"; }

std::string StepNotTestable(const PhysicsContext& c, const EffectRequest& request) {
  const bool at_s = request.settings.count("at_s") > 0;
  if (at_s && request.settings.count("at_row") > 0) {
    return "at_s and at_row both say when; keep one of them";
  }
  if (at_s && !c.has_one_clock()) {
    return fmt::format("at_s needs a time in every row, but {}; add it, or give at_row instead",
                       c.has_time() ? "t_s of one run lies before that of the run before it"
                       : c.recording().time.size() == 0 ? "the recording has no column t_s"
                                                        : "the column t_s has blank cells");
  }
  const char* const setting = StepSetting(c);
  if (request.settings.count(setting) == 0) return fmt::format("needs the setting {}", setting);
  const double share = StepProfile(c, request).mean();
  if (share <= 0 || share >= 1) return "no row lies on one side of the instant";
  return "";
}

Eigen::VectorXd StepProfile(const PhysicsContext& c, const EffectRequest& request) {
  const double at = Instant(request);
  return c.clock().unaryExpr([&](double t) { return t >= at ? 1.0 : 0.0; });
}

std::vector<double> Instants(const PhysicsContext& c) {
  std::vector<double> times(c.clock().begin(), c.clock().end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<EffectRequest> StepCandidates(const PhysicsContext& c,
                                          const std::vector<EffectRequest>& requests) {
  const std::vector<double> times = Instants(c);
  std::vector<EffectRequest> candidates;
  const auto count = static_cast<int>(times.size());
  for (const EffectRequest& request : requests) {
    for (int k = 1; k <= kInstants; ++k) {
      const int at = k * count / (kInstants + 1);
      if (at < 1 || at >= count) continue;
      candidates.push_back(request);
      candidates.back().settings[StepSetting(c)] = times[static_cast<std::size_t>(at)];
    }
  }
  return candidates;
}

std::string StepWords(const EffectRequest& request) {
  const auto time = request.settings.find("at_s");
  if (time != request.settings.end()) return fmt::format("after {:.4g} min", time->second / 60);
  return fmt::format("after row {:.0f}", request.setting("at_row", 0));
}

}  // namespace dhcal
