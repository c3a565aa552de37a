#include "tools/compensate/expected_error.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/kinematics/slots.h"
#include "problems/formats/result/result_reader.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;

ParameterCovariance FromPart(const Json& part) {
  ParameterCovariance known;
  for (const Json& parameter : part.at("parameters")) {
    if (parameter.at("verdict") == "fixed") continue;
    known.names.push_back(parameter.at("name").get<std::string>());
  }
  const auto size = static_cast<Eigen::Index>(known.names.size());
  known.covariance.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double value = part.at("covariance")
                               .at(static_cast<std::size_t>(i))
                               .at(static_cast<std::size_t>(j))
                               .get<double>();
      known.covariance(i, j) = known.covariance(j, i) = value;
    }
  }
  return known;
}

/// Slot of a geometric parameter, "tool_z.A" or "theta1"; -1 where the name is an effect's.
int SlotOf(const SlotLayout& slots, const std::string& name) {
  const std::string stem = name.substr(0, name.find('.'));
  for (int slot = 0; slot < slots.size(); ++slot) {
    if (slots.Name(slot) == stem) return slot;
  }
  return -1;
}

/// Whether a parameter acts on a row: one of a run or target acts on theirs.
bool ActsOn(const std::string& name, const Recording& rows, int row) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return true;
  const std::string owner = name.substr(dot + 1);
  const auto is = [&](const std::vector<std::string>& names, int idx) {
    return !names.empty() && names[static_cast<std::size_t>(idx)] == owner;
  };
  return is(rows.run_names, rows.run(row)) || is(rows.target_names, rows.target(row));
}

}  // namespace

std::optional<ParameterCovariance> ReadCovariance(const std::string& result_json,
                                                  Diagnostics* diagnostics) {
  std::error_code status;
  if (!std::filesystem::exists(result_json, status)) return std::nullopt;
  std::optional<ParameterCovariance> covariance;
  TakeFromResult(
      result_json,
      [&](const Json& root) {
        const Json part = DeliveredPart(root);
        if (!part.is_null() && part.contains("covariance")) covariance = FromPart(part);
      },
      diagnostics);
  return covariance;
}

std::optional<Eigen::VectorXd> ExpectedErrors(const ProblemSpec& spec,
                                              const Recording& rows,
                                              const RealArm& arm,
                                              const Eigen::MatrixXd& q,
                                              const ParameterCovariance& known) {
  // Along edges the base is known in each edge's frame only.
  if (spec.measurement.kind.edges) return std::nullopt;
  const Eigen::MatrixXd deltas = arm.Deltas(q);
  std::map<std::string, EffectMove> effects;
  for (EffectMove& move : arm.Moves(q, deltas)) effects.emplace(move.parameter, move);
  const auto size = static_cast<Eigen::Index>(known.names.size());
  Eigen::VectorXd sigma(rows.num_rows());
  for (int row = 0; row < rows.num_rows(); ++row) {
    PoseWithDerivatives pose;
    arm.chain().PoseAndDerivatives(q.row(row).transpose(), deltas.col(row), arm.ends(row), &pose);
    Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const std::string& name = known.names[static_cast<std::size_t>(k)];
      if (const int slot = SlotOf(arm.chain().slots(), name); slot >= 0) {
        if (ActsOn(name, rows, row)) J.col(k) = pose.J_p.col(slot);
      } else if (const auto effect = effects.find(name); effect != effects.end()) {
        for (const SlotWeights& weights : effect->second.slots) {
          J.col(k) += weights.weight[row] * pose.J_p.col(weights.slot);
        }
      }
    }
    sigma[row] = std::sqrt(std::max(0.0, (J * known.covariance * J.transpose()).trace()));
  }
  return sigma;
}

}  // namespace dhcal
