// Error curve of a joint's transmission or encoder: any function of the joint's own angle.
//
//   d theta_j = sum_k c_k B_k(q_j)          c_k [rad]
//
// B_k: cubic B-splines on equally spaced knots of the turn, so that the curve closes; only knots
// near which the recording has rows. Strain-wave and cycloid gears err at many orders at once, and
// a few lines follow such a curve only where there are rows: between them they swing freely, while
// a coefficient without rows stays at zero (its prior). So the curve holds where the joint has been
// and claims nothing elsewhere.
// Typical: 0.1-0.3 mrad RMS. Source: PHYSICS.md G1-G3; de Boor 1978 for the splines.
// Worked number: one coefficient of 0.3 mrad, at its knot, adds 2/3 of that, 0.2 mrad.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/columns.h"

namespace dhcal {
namespace {

constexpr double kSpread = 3e-4;         // [rad] of a coefficient
constexpr double kTypicalError = 3e-5;   // [rad]
constexpr double kDefaultKnot_deg = 3;   // finer than a mesh of 40 per turn
constexpr double kFewestSquares = 0.01;  // of a column's weights: a row at the edge of a spline

/// The four splines that are not zero at a fraction of the way from a knot to the next.
std::array<double, 4> CubicSplines(double f) {
  const double g = 1 - f;
  return {g * g * g / 6,
          (3 * f * f * f - 6 * f * f + 4) / 6,
          (3 * g * g * g - 6 * g * g + 4) / 6,
          f * f * f / 6};
}

class TransmissionErrorEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{
        "transmission_error",
        "a gear or encoder errs by a curve of the joint's own angle, at many orders at once",
        "d theta_j = sum_k c_k B_k(q_j), cubic splines",
        "at_<knot's angle in degrees> [rad]",
        {{"knot_deg", "distance of knots in degrees, default 3"}},
        "several significant lines of gear_harmonic at one joint",
        "0.1-0.3 mrad RMS [PHYSICS.md G1-G3]"};
    d.is_curve = true;
    return d;
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    if (!c.revolute(JointIndex(request))) return "the joint is prismatic";
    const double knot_deg = request.setting("knot_deg", kDefaultKnot_deg);
    if (!(knot_deg >= 0.5 && knot_deg <= 60)) return "knot_deg must be from 0.5 to 60";
    return c.moves(JointIndex(request)) ? "" : "the joint does not move";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int joint = JointIndex(request);
    const Eigen::VectorXd q = c.q(joint);
    const auto count =
        static_cast<Eigen::Index>(std::lround(360 / request.setting("knot_deg", kDefaultKnot_deg)));
    const double distance = 2 * kPi / static_cast<double>(count);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(q.size(), count);
    for (Eigen::Index row = 0; row < q.size(); ++row) {
      const double at = q[row] / distance;
      const double knot = std::floor(at);
      const std::array<double, 4> splines = CubicSplines(at - knot);
      for (int k = 0; k < 4; ++k) {
        const auto turned = static_cast<Eigen::Index>(knot) + k - 1;
        weights(row, ((turned % count) + count) % count) += splines[static_cast<std::size_t>(k)];
      }
    }
    std::vector<EffectColumn> columns;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (weights.col(k).squaredNorm() < kFewestSquares) continue;
      const double angle = std::remainder(static_cast<double>(k) * distance, 2 * kPi);
      columns.push_back(SlotColumn(fmt::format("at_{:g}", std::round(angle / kDegree * 100) / 100),
                                   "rad",
                                   kTypicalError,
                                   c.joint_slot(joint),
                                   weights.col(k)));
      columns.back().prior_sigma = kSpread;
    }
    return columns;
  }

  /// None by itself: a curve can imitate any function of the joint's angle. The search offers it
  /// where a joint shows so many lines that no few orders are its cause.
  std::vector<EffectRequest> Candidates(const PhysicsContext& /*c*/) const override { return {}; }

  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& request) const override {
    return {"C8", JointName(request.joint), "joint angle"};
  }

  std::string Sentence(const PhysicsContext& context,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    double mean = 0, square = 0;
    const double count = std::max<double>(1, static_cast<double>(values.size()));
    for (const EffectValue& value : values) mean += value.value / count;
    EffectValue largest;
    for (EffectValue value : values) {
      value.value = std::abs(value.value - mean);
      square += value.value * value.value / count;
      if (value.value >= largest.value) largest = value;
    }
    return fmt::format(
        "{} has an angle-dependent transmission error: {:.2f} mrad RMS, {} peak (typical of gears "
        "and "
        "encoders)",
        JointWords(context, request.joint),
        std::sqrt(square) / 1e-3,
        Quantity(largest, 1e-3, "mrad"));
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "transmission_error";
    example.request.joint = 3;
    example.request.values["at_30"] = 3e-4;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 2e-4;
    return example;
  }
};

}  // namespace

const Effect& TransmissionError() {
  static const TransmissionErrorEffect effect;
  return effect;
}

}  // namespace dhcal
