// Abbe error of the camera: the face that it looks at stands at another height than the file says.
//
//   d ruler = h u.x / u.z          h [m]: the ruled face is higher by so much
//
// The stand-off of the camera itself does not matter, its sight stays the same line. Free heights
// of the placements take most of it: they differ by what a tilted laser reads longer. Typical:
// 0.3 mm. Source: PHYSICS.md S9. Worked number: h = 0.3 mm, u.x / u.z =
// 25.91: 7.77 mm.
#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

class CameraAbbeEffect final : public EffectOfHead {
 public:
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    const auto error = [](int /*row*/, const HeadSights& seen) {
      return Eigen::Vector3d(seen.camera.ruler_by_plane(), 0, 0);
    };
    return {HeadRows(c).Column("height", "m", 3e-4, error)};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"C10", "sensor", "tilt"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the camera looks at rulings that stand {} higher than the file says",
                       Quantity(Find(values, "height"), 1e-3, "mm"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "camera_abbe";
    example.request.values["height"] = 3e-4;
    example.row = 1;
    example.slot = "base_x";
    example.expected = 0.007772010629674415;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"camera_abbe",
            "the ruled face is at another height than the file says",
            "d ruler = h u.x / u.z",
            "height [m]",
            {},
            "measurement kind straight_edge, the tool tilted along the edge",
            "0.1-1 mm [PHYSICS.md S9]"};
  }
};

}  // namespace

const Effect& CameraAbbe() {
  static const CameraAbbeEffect effect;
  return effect;
}

}  // namespace dhcal
