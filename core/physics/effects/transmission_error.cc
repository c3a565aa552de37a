// Error curve of a joint's transmission or encoder: any function of the joint's own angle.
//
//   d theta_j = sum_k c_k B_k(q_j)          c_k [rad]
//
// B_k: cubic B-splines on equally spaced knots of the turn, so that the curve closes; only knots
// near which the recording has rows. Strain-wave and cycloid gears err at many orders at once, and
// a few lines follow such a curve only where there are rows: between them they swing freely, while
// a coefficient without rows stays at zero (its prior). So the curve holds where the joint has been
// and claims nothing elsewhere.
// Typical: 0.1-0.3 mrad RMS. Source: physics.md G1-G3; de Boor 1978 for the splines.
// Worked number: one coefficient of 0.3 mrad, at its knot, adds 2/3 of that, 0.2 mrad.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/joint_effect.h"

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

class TransmissionErrorEffect final : public JointEffect {
 public:
  TransmissionErrorEffect()
      : JointEffect(About(),
                    {EffectClass::kGearLine, DriverKind::kJointAngle, JointNeeds::kTurningMotion}) {
  }

  std::string NotTestableAt(const PhysicsContext& /*c*/,
                            const EffectRequest& request) const override {
    const double knot_deg = request.setting("knot_deg", kDefaultKnot_deg);
    return knot_deg >= 0.5 && knot_deg <= 60 ? "" : "knot_deg must be from 0.5 to 60";
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

  std::string Sentence(const EffectRequest& request,
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
        "joint {} errs by a curve of its own angle, {:.2f} mrad RMS and at most {}, as gears and "
        "encoders do that err at many orders at once",
        request.joint,
        std::sqrt(square) / 1e-3,
        Quantity(largest, 1e-3, "mrad"));
  }

  WorkedExample Example() const override {
    return {WithValue(Request(3), "at_30", 3e-4), 1, "theta3", 2e-4};
  }

 private:
  static EffectDescription About() {
    EffectDescription d{
        "transmission_error",
        "a gear or encoder errs by a curve of the joint's own angle, at many orders at once",
        "d theta_j = sum_k c_k B_k(q_j), cubic splines",
        "at_<knot's angle in degrees> [rad]",
        {Number("knot_deg", "distance of knots in degrees, default 3")},
        "several significant lines of one joint's gear",
        "0.1-0.3 mrad RMS [physics.md G1-G3]"};
    d.is_curve = true;
    return d;
  }
};

}  // namespace

const Effect& TransmissionError() {
  static const TransmissionErrorEffect effect;
  return effect;
}

}  // namespace dhcal
