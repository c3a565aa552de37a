// Linearity of one laser: its reading is a bent function of the distance.
//
//   d height = g t + a t^2 + b t^3,  t = height - h0          g [1], a [1/m], b [1/m^2]
//
// with h0 the mean height of the recording: where the laser's own middle lies is not known, and a
// bent line about another point has another gain. Typical: 0.05 % of 50 mm. Source: PHYSICS.md S6.
// Worked number: g = 1e-3 at t = -11.59 m: -11.6 mm of laser 1 alone, -2.4 mm in base_z.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

struct Power {
  const char* name;
  const char* unit;
  double typical;
  int exponent;
  double unit_shown;
  const char* words;
};

constexpr Power kPowers[] = {{"gain", "1", 1e-3, 1, 1e-2, "%"},
                             {"quadratic", "1/m", 4e-2, 2, 1e-2, "um at 10 mm, squared"},
                             {"cubic", "1/m^2", 1.6, 3, 1, "um at 10 mm, cubed"}};

class LaserLinearityEffect final : public EffectOfLaser {
 public:
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const HeadRows rows(c);
    const int laser = LaserIndex(request);
    const auto column = [&](const Power& power) {
      return rows.Column(fmt::format("{}_laser{}", power.name, laser + 1),
                         power.unit,
                         power.typical,
                         [&](int /*row*/, const HeadSights& seen) {
                           const double t = seen.numbers()[laser + 1] - rows.Mean(laser + 1);
                           Eigen::Vector3d error = Eigen::Vector3d::Zero();
                           error[laser + 1] = std::pow(t, power.exponent);
                           return error;
                         });
    };
    return {column(kPowers[0]), column(kPowers[1]), column(kPowers[2])};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"reading", "sensor", "height"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const int laser = LaserIndex(request) + 1;
    const auto term = [&](const Power& power) {
      return Quantity(Find(values, fmt::format("{}_laser{}", power.name, laser)),
                      power.unit_shown,
                      power.words);
    };
    return fmt::format("laser {} reads distances wrongly about their middle: by {}, {} and {}",
                       laser,
                       term(kPowers[0]),
                       term(kPowers[1]),
                       term(kPowers[2]));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "laser_linearity";
    example.request.settings["laser"] = 1;
    example.request.values["gain_laser1"] = 1e-3;
    example.row = 1;
    example.slot = "base_z";
    example.expected = -0.0024061797129393816;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"laser_linearity",
            "the reading of a laser is no linear function of the distance",
            "d height = g t + a t^2 + b t^3, t = height - its mean",
            "gain_laser<k> [1], quadratic_laser<k> [1/m], cubic_laser<k> [1/m^2]",
            {{"laser", "1 or 2"}},
            "measurement kind straight_edge",
            "25 um at 25 mm from the middle [PHYSICS.md S6]"};
  }
};

}  // namespace

const Effect& LaserLinearity() {
  static const LaserLinearityEffect effect;
  return effect;
}

}  // namespace dhcal
