#include "core/solver/truncation.h"

#include <limits>

#include <fmt/format.h>

namespace dhcal {
namespace {

// A parameter that has a prior is scaled by it, and its prior row alone then gives s = 1: rounding
// must not drop what the prior determines.
constexpr double kNoiseCut = 1.0 - 1e-6;

}  // namespace

TruncatedSvd Truncate(const Truncation& truncation,
                      const Eigen::VectorXd& tolerance,
                      const Linearization& linearization) {
  const bool raw = truncation.rule == TruncationRule::kPaper;
  const auto columns = static_cast<double>(tolerance.size());
  TruncatedSvd svd = DecomposeScaled(
      linearization.R, raw ? Eigen::VectorXd(Eigen::VectorXd::Ones(tolerance.size())) : tolerance);
  switch (truncation.rule) {
    case TruncationRule::kPaper:
      SetCut(columns * std::numeric_limits<double>::epsilon() * svd.s[0], &svd);
      break;
    case TruncationRule::kNoise:
      SetCut(kNoiseCut, &svd);
      break;
    case TruncationRule::kRelative:
      SetCut(truncation.relative * svd.s[0], &svd);
      break;
  }
  return svd;
}

std::string Describe(const Truncation& truncation) {
  switch (truncation.rule) {
    case TruncationRule::kPaper:
      return "paper rule: raw Jacobian, cut at columns x machine epsilon x largest";
    case TruncationRule::kNoise:
      return "noise rule: columns in tolerances, rows in noise, cut at 1";
    case TruncationRule::kRelative:
      return fmt::format("relative rule: columns in tolerances, cut at {:g} x largest",
                         truncation.relative);
  }
  return "";
}

}  // namespace dhcal
