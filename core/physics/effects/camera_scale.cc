// Scale of the camera: its millimetres per pixel are off.
//
//   d ruler = s v,  v = reading - the nearest multiple of the pitch          s [1]
//
// A camera measures from the ruling nearest to the middle of its image, so v is the offset in the
// image, within half a pitch. Where v is the same at all rows it is a constant and hidden. v is
// taken from the reading: over a whole pitch it is as good as independent of the reading's error.
// Close to half a pitch the nearest multiple need not be the ruling that the camera measured from:
// such rows say nothing of s (an offset of the wrong sign there took 14 % off it).
// Typical: 1 %. Source: PHYSICS.md S8. Worked number: s = 1 %, 0.299 mm before a ruling:
// -2.99 um.
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/physics/columns.h"
#include "core/physics/head_rows.h"

namespace dhcal {
namespace {

constexpr double kSurelyNearest = 0.45;  // of the pitch

/// v, or 0 where it may be that of the neighbouring ruling. Rows that are yet to be simulated have
/// it from where the camera looks.
double OffsetInTheImage(const PhysicsContext& c, int row, const HeadSights& seen) {
  const double pitch = *c.robot().head->pitch;
  if (c.recording().head.rows() == 0) return std::remainder(seen.camera.at.x(), pitch);
  const double offset = std::remainder(c.recording().head(row, 0), pitch);
  return std::abs(offset) < kSurelyNearest * pitch ? offset : 0;
}

/// True if readings crowd so much that an offset would be their error more than a place.
bool StandsBetweenTheSame(const PhysicsContext& c) {
  constexpr double kCrowded = 0.5;  // resultant length of the phases; 0 = evenly over a pitch
  if (c.recording().head.rows() == 0) return false;
  std::complex<double> sum = 0;
  int count = 0;
  for (int row = 0; row < c.num_rows(); ++row) {
    const double reading = c.recording().head(row, 0);
    if (!std::isfinite(reading)) continue;
    sum += std::polar(1.0, 2 * kPi * reading / *c.robot().head->pitch);
    ++count;
  }
  return count == 0 || std::abs(sum) > kCrowded * count;
}

class CameraScaleEffect final : public EffectOfHead {
 public:
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    std::string missing = EffectOfHead::NotTestable(c, request);
    if (!missing.empty()) return missing;
    if (!c.robot().head->pitch) {
      return "the file does not say how far apart the rulings are (measurement.head.pitch_mm)";
    }
    return StandsBetweenTheSame(c)
               ? "the ruler was read at about the same place between two rulings"
               : "";
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& /*request*/) const override {
    const HeadRows rows(c);
    const auto error = [&](int row, const HeadSights& seen) {
      return Eigen::Vector3d(OffsetInTheImage(c, row, seen), 0, 0);
    };
    return {rows.Column("scale", "1", 1e-2, error)};
  }
  EffectPlace Place(const PhysicsContext& /*c*/, const EffectRequest& /*request*/) const override {
    return {"reading", "sensor", "offset in the image"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& /*request*/,
                       const std::vector<EffectValue>& values) const override {
    return fmt::format("the camera reads offsets from the nearest ruling too long by {}",
                       Quantity(Find(values, "scale"), 1e-2, "%"));
  }
  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "camera_scale";
    example.request.values["scale"] = 1e-2;
    example.row = 1;
    example.slot = "base_x";
    example.expected = -2.9916842735370868e-06;
    return example;
  }

 private:
  EffectDescription Words() const override {
    return {"camera_scale",
            "the camera's millimetres per pixel are off",
            "d ruler = s v, v = reading - its nearest ruling",
            "scale [1]",
            {},
            "measurement kind straight_edge, measurement.head.pitch",
            "1 % of the offset from the nearest ruling [PHYSICS.md S8]"};
  }
};

}  // namespace

const Effect& CameraScale() {
  static const CameraScaleEffect effect;
  return effect;
}

}  // namespace dhcal
