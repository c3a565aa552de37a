// Misalignment of the edge's faces: the ruled one is not parallel to the flat one.
//
//   z(x) = c + p (x - x0) of the ruled face, d ruler = p (x - x0) u.x / u.z      p [rad]
//
// with x0 the middle of a placement's readings. Only the part along the rulings moves a reading,
// and only where the camera's sight leans along the edge: what both faces do alike is the pose of
// the placement. Typical: 0.1 mrad. Source: PHYSICS.md S5.
// Worked number: p = 0.1 mrad, 8.010 m before the middle, u.x / u.z = 25.91: -20.8 mm.
#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

class EdgeMisalignmentEffect final : public EffectOfHead {
 public:
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    const HeadRows rows(c);
    const auto error = [&](int row, const HeadSights& seen) {
      const double along = seen.camera.at.x() - rows.MeanOfEdge(row, 0);
      return Eigen::Vector3d(along * seen.camera.ruler_by_plane(), 0, 0);
    };
    return {rows.Column("pitch", "rad", 1e-4, error)};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C10", "sensor", "ruler and tilt"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the ruled face of the straight edge climbs by {} against the flat one",
                       Quantity(Find(values, "pitch"), 1e-3, "mrad"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "edge_misalignment";
    example.request.values["pitch"] = 1e-4;
    example.row = 1;
    example.slot = "base_x";
    example.expected = -0.020750360569491987;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"edge_misalignment",
            "the ruled face of the edge is not parallel to the flat one",
            "d ruler = p (x - x0) u.x / u.z",
            "pitch [rad]",
            {},
            "measurement kind straight_edge, the tool tilted along the edge",
            "0.1 mrad [PHYSICS.md S5]"};
  }
};

}  // namespace

const Effect& EdgeMisalignment() {
  static const EdgeMisalignmentEffect effect;
  return effect;
}

}  // namespace dhcal
