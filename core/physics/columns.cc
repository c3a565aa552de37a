#include "core/physics/columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace dhcal {

EffectColumn SlotColumn(
    std::string parameter, std::string unit, double typical, int slot, Eigen::VectorXd weight) {
  EffectColumn column;
  column.parameter = std::move(parameter);
  column.unit = std::move(unit);
  column.typical = typical;
  column.slots.push_back({slot, std::move(weight)});
  return column;
}

std::vector<EffectColumn> FrameColumns(int first_slot,
                                       int components,
                                       double typical,
                                       const Eigen::VectorXd& weight,
                                       const std::string& suffix) {
  std::vector<EffectColumn> columns;
  for (int k = 0; k < components; ++k) {
    columns.push_back(SlotColumn(SlotLayout::ComponentName(k) + suffix,
                                 k < 3 ? "m" : "rad",
                                 typical,
                                 first_slot + k,
                                 weight));
  }
  return columns;
}

EffectColumn TwistColumn(const PhysicsContext& context,
                         std::string parameter,
                         std::string unit,
                         double typical,
                         const std::function<Twist(int row_idx)>& twist) {
  EffectColumn column;
  column.parameter = std::move(parameter);
  column.unit = std::move(unit);
  column.typical = typical;
  for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
    column.slots.push_back({context.slots().base(k), Eigen::VectorXd(context.num_rows())});
  }
  for (int row = 0; row < context.num_rows(); ++row) {
    const Eigen::Matrix<double, 6, 1> delta = context.AsBaseSlots(row, twist(row));
    for (int k = 0; k < SlotLayout::kPerFrame; ++k) {
      column.slots[static_cast<std::size_t>(k)].weight[row] = delta[k];
    }
  }
  return column;
}

std::vector<EffectRequest> EveryJoint(const PhysicsContext& context,
                                      const std::string& effect,
                                      bool revolute_only) {
  std::vector<EffectRequest> requests;
  for (int joint = 0; joint < context.num_joints(); ++joint) {
    if (revolute_only && !context.revolute(joint)) continue;
    EffectRequest request;
    request.effect = effect;
    request.joint = joint + 1;
    requests.push_back(request);
  }
  return requests;
}

std::vector<EffectRequest> WithVariant(const Effect& effect,
                                       const PhysicsContext& context,
                                       std::vector<EffectRequest> requests,
                                       const std::string& setting) {
  const auto count = requests.size();
  for (std::size_t k = 0; k < count; ++k) {
    EffectRequest variant = requests[k];
    variant.settings[setting] = 1;
    if (effect.NotTestable(context, variant).empty()) requests.push_back(variant);
  }
  return requests;
}

bool IsConstant(const Eigen::VectorXd& driver) {
  if (driver.size() == 0 || !driver.allFinite()) return true;
  const double spread = driver.maxCoeff() - driver.minCoeff();
  // Of its size; what drives an effect of usual size by less moves nothing that could be read. The
  // jitter of joints at rest makes loads vary by a millionth.
  constexpr double kSpread = 1e-5;
  return !(spread > kSpread * std::max(1.0, driver.cwiseAbs().maxCoeff()));
}

std::string JointName(int joint_from_1) { return fmt::format("joint {}", joint_from_1); }

std::string CheckJoint(const PhysicsContext& context, const EffectRequest& request) {
  if (request.joint >= 1 && request.joint <= context.num_joints()) return "";
  return fmt::format("needs a joint from 1 to {}", context.num_joints());
}

std::string Quantity(const EffectValue& value, double unit_size, const std::string& unit) {
  const double shown = value.value / unit_size, sigma = value.sigma / unit_size;
  int decimals = 3;
  if (sigma > 0 && std::isfinite(sigma)) {
    decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 6);
  }
  return fmt::format("{:.{}f} +- {:.{}f} {}", shown, decimals, sigma, decimals, unit);
}

std::string AmountOfJoint(const EffectValue& value) {
  const std::size_t slash = value.unit.find('/');
  const std::string per = slash == std::string::npos ? "" : value.unit.substr(slash);
  return Quantity(value, 1e-3, (value.unit[0] == 'm' ? "mm" : "mrad") + per);
}

std::string ComponentsInWords(const std::vector<EffectValue>& values,
                              int components,
                              const std::string& unit_of_lengths) {
  std::string text;
  for (int k = 0; k < components; ++k) {
    const std::string name = SlotLayout::ComponentName(k);
    text += fmt::format("{}{} {}",
                        k > 0 ? ", " : "",
                        name,
                        Quantity(Find(values, name), 1e-3, k < 3 ? unit_of_lengths : "mrad"));
  }
  return text;
}

EffectValue Find(const std::vector<EffectValue>& values, const std::string& parameter) {
  for (const EffectValue& value : values) {
    if (value.parameter == parameter) return value;
  }
  return {parameter, "", 0, 0};
}

EffectValue Amplitude(const EffectValue& a, const EffectValue& b) {
  EffectValue result{"amplitude", a.unit, std::hypot(a.value, b.value), 0};
  if (result.value > 0) {
    result.sigma = std::hypot(a.value * a.sigma, b.value * b.sigma) / result.value;
  } else {
    result.sigma = std::hypot(a.sigma, b.sigma);
  }
  return result;
}

}  // namespace dhcal
