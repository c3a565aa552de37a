// Slow drift of the instrument's scale: all that it reads grows about its own origin.
//
//   reading = (1 + s u) p, so base_xyz += s u (p_WQ - p_WO)        s [1], or [1/K] with
//   temperatures
//
// with p_WQ as the model predicts it, and O the place from which the instrument reads: the anchor
// of a distance, else the origin of W. u: the course of a drift (core/physics/drift.h). Its mean
// over the rows would be sensor_scale, which no reading of this kind shows; its change is seen.
// Typical: 20 ppm over a warm-up, 5 ppm/K. Source: PHYSICS.md S3.
// Worked number: s = 5 ppm/K at +10 K, 1.907739 m above the anchor: +95.4 um.
#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/drift.h"

namespace dhcal {
namespace {

class InstrumentDriftEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"instrument_drift",
                        "the instrument's scale changes slowly during the recording",
                        "base_xyz += s u (p_WQ - p_WO), O where the instrument reads from",
                        "scale [1], or [1/K] with temperatures",
                        {{"time_constant_s", "by the clock; 0 = steadily"}},
                        "temperature_C, or t_s with time_constant_s",
                        "5-50 ppm over a warm-up [PHYSICS.md S3]"};
    d.has_joint = false;
    d.of_instrument = true;
    return d;
  }
  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    const bool reads = c.recording().distance.size() > 0 || c.robot().anchors.empty();
    if (!reads) return "no row says to which anchor its distance is read";
    return DriftNotTestable(c, request, 0);
  }
  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const Eigen::VectorXd u = DriftProfile(c, request, 0);
    const bool clock = DriftByTime(c, request);
    Eigen::Matrix3Xd growth(3, c.num_rows());
    for (int row = 0; row < c.num_rows(); ++row) {
      const Anchor* const anchor = c.anchor(row);
      growth.col(row) = u[row] * (anchor == nullptr ? c.p_WQ(row) : c.p_WQ(row) - anchor->p_WA);
    }
    EffectColumn column;
    column.parameter = "scale";
    column.unit = clock ? "1" : "1/K";
    column.typical = clock ? 2e-5 : 5e-6;
    for (int k = 0; k < 3; ++k) column.slots.push_back({c.slots().base(k), growth.row(k)});
    return {column};
  }
  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    EffectRequest request;
    request.effect = "instrument_drift";
    return DriftCandidates(c, {request});
  }
  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {"C5", "sensor", DriftByTime(c, request) ? "time" : "temperature"};
  }
  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const bool clock = request.settings.count("time_constant_s") > 0;
    return fmt::format("the instrument's scale drifts{}: its readings grow by {}",
                       DriftWords(request),
                       Quantity(Find(values, "scale"), 1e-6, clock ? "ppm" : "ppm per K"));
  }
  WorkedExample Example() const override {
    // The point stands 0.642739 m above W's origin and the anchor 1.265 m below it.
    WorkedExample example;
    example.request.effect = "instrument_drift";
    example.request.values["scale"] = 5e-6;
    example.row = 1;
    example.slot = "base_z";
    example.expected = 5e-5 * 1.9077389392319204;
    return example;
  }
};

}  // namespace

const Effect& InstrumentDrift() {
  static const InstrumentDriftEffect effect;
  return effect;
}

}  // namespace dhcal
