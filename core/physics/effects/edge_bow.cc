// Bow of the straight edge: its faces are no planes but bent alike along the rulings.
//
//   z(x) = k (x - x0)^2 / 2, of both faces            k [1/m]; > 0: the ends stand higher
//   d height = z / u.z,  d ruler = z u.x / u.z        where the sensor's sight meets the face
//
// with x0 the middle of a placement's readings: another one is a pitch and a height of the
// placement, which are free. All placements are of one edge. Bent across (in the plane of the
// faces) no sensor sees it. Typical: 0.03-0.1 mm over 0.5 m. Source: PHYSICS.md S4.
// Worked number: k = 1e-3 1/m at spots 6.7 m and 9.3 m from the middle, u.z = 0.0364: -86 mm in
// base_z.
#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

constexpr double kChord = 0.5;  // [m]

double Squared(double x) { return x * x; }

class EdgeBowEffect final : public EffectOfHead {
 public:
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    const HeadRows rows(c);
    const auto error = [&](int row, const HeadSights& seen) {
      const double middle = rows.MeanOfEdge(row, 0);
      const auto rise = [&](const Sight& sight) { return 0.5 * Squared(sight.at.x() - middle); };
      return Eigen::Vector3d(rise(seen.camera) * seen.camera.ruler_by_plane(),
                             rise(seen.lasers[0]) * seen.lasers[0].length_by_plane(),
                             rise(seen.lasers[1]) * seen.lasers[1].length_by_plane());
    };
    return {rows.Column("curvature", "1/m", 1e-3, error)};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"edge", "sensor", "ruler"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    // A chord of length L stands L^2 / 8 curvatures off its arc.
    constexpr double kCurvatureOfMillimetre = 8e-3 / (kChord * kChord);
    return fmt::format("the straight edge is bowed by {} over {:.1f} m{}",
                       Quantity(Find(values, "curvature"), kCurvatureOfMillimetre, "mm"),
                       kChord,
                       Find(values, "curvature").value > 0 ? ", its ends higher than its middle"
                                                           : ", its middle higher than its ends");
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "edge_bow";
    example.request.values["curvature"] = 1e-3;
    example.row = 1;
    example.slot = "base_z";
    example.expected = -0.08626816654743924;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"edge_bow",
            "the straight edge is bowed along its rulings",
            "d height = k (x - x0)^2 / (2 u.z), d ruler = k (x - x0)^2 u.x / (2 u.z)",
            "curvature [1/m]",
            {},
            "measurement kind straight_edge",
            "1e-3 1/m: 30 um over 0.5 m [PHYSICS.md S4]"};
  }
};

}  // namespace

const Effect& EdgeBow() {
  static const EdgeBowEffect effect;
  return effect;
}

}  // namespace dhcal
