#include "core/physics/drift.h"

#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"

namespace dhcal {
namespace {

constexpr char kTimeConstant[] = "time_constant_s";

/// Parts of the recording's duration that are tried as time constants; 0 = a steady drift.
constexpr double kTimeConstants[] = {0.05, 0.12, 0.3, 0.0};

Eigen::VectorXd Temperature(const PhysicsContext& c, int joint) {
  const Eigen::MatrixXd& all = c.recording().temperature;
  if (all.rows() == 0) return {};
  return all.col(all.cols() == 1 ? 0 : joint);
}

bool HasTemperature(const PhysicsContext& c, int joint) {
  return !IsConstant(Temperature(c, joint));
}

}  // namespace

EffectSetting TimeConstantSetting() {
  return Scanned(Number(kTimeConstant, "by the clock; 0 = steadily"), SettingScan::kTimeConstants);
}

Driver DriftDriver(const PhysicsContext& c, const EffectRequest& request) {
  return {DriftByTime(c, request) ? DriverKind::kTime : DriverKind::kTemperature};
}

bool DriftByTime(const PhysicsContext& c, const EffectRequest& request) {
  return request.settings.count(kTimeConstant) > 0 || c.recording().temperature.rows() == 0;
}

std::string DriftNotTestable(const PhysicsContext& c, const EffectRequest& request, int joint) {
  if (!DriftByTime(c, request)) {
    return HasTemperature(c, joint) ? "" : "the temperature is constant or has blanks";
  }
  if (!c.has_time()) return "the recording has neither temperatures nor a clock (t_s)";
  return c.duration() > 0 ? "" : "all rows of a run have the same time";
}

Eigen::VectorXd DriftProfile(const PhysicsContext& c, const EffectRequest& request, int joint) {
  if (!DriftByTime(c, request)) {
    const Eigen::VectorXd temperature = Temperature(c, joint);
    return temperature.array() - temperature[0];
  }
  const double constant = request.setting(kTimeConstant, 0);
  if (constant <= 0) return c.drift_clock() / c.duration();
  return 1.0 - (-c.drift_clock().array() / constant).exp();
}

std::vector<EffectRequest> DriftCandidates(const PhysicsContext& c,
                                           const std::vector<EffectRequest>& requests) {
  std::vector<EffectRequest> candidates;
  for (const EffectRequest& request : requests) {
    if (HasTemperature(c, request.joint > 0 ? request.joint - 1 : 0)) {
      candidates.push_back(request);
    }
    if (!c.has_time() || c.duration() <= 0) continue;
    for (const double part : kTimeConstants) {
      candidates.push_back(request);
      candidates.back().settings[kTimeConstant] = part * c.duration();
    }
  }
  return candidates;
}

std::string DriftWords(const EffectRequest& request) {
  const auto found = request.settings.find(kTimeConstant);
  if (found == request.settings.end()) return "";
  if (found->second <= 0) return " steadily over the recording";
  return fmt::format(" with a time constant of {:.3g} min", found->second / 60);
}

}  // namespace dhcal
