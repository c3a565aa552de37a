// Bending of a link: a beam from its joint to the next bends under all that it carries.
//
//   rotation    phi   = (M_perp L + (e x F) L^2 / 2) / EI            about the link's far end
//   translation delta = (F_perp L^3 / 3 + (M x e) L^2 / 2) / EI
//
// F, M: gravity's force and moment of what lies beyond the far end; e, L: direction and length of
// the beam; parameter 1/EI [1/(N m^2)], positive. (Euler-Bernoulli cantilever, equal stiffness in
// both planes; the link's own weight is not counted.)
// Link j is the body that joint j moves, whatever the convention: modified row j ends in a frame
// that sits on axis j, so the beam of link j lies in row j + 1.
// Typical: EI = 0.5-3e6 N m^2 of cast aluminium, 0.02-0.1 mm. Source: PHYSICS.md E3.
// Worked number: 40 kg at the end of a 0.65 m beam, EI = 1e6: see the conformance test.
#include <cmath>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"

namespace dhcal {
namespace {

constexpr double kTypicalBending = 1e-6;  // [1/(N m^2)]
constexpr double kShortestBeam = 0.2;     // [m] what is shorter does not bend

/// Where the beam of link `link` (from 0) starts and that of the link before ends: on the axis of
/// the link's joint, where the common normal with the axis before meets it. A standard row ends
/// there; in modified rows the offset d along the axis follows, and belongs to the link as it does
/// in standard rows.
Eigen::Vector3d BeamStart(const PhysicsContext& c, int row, int link) {
  const Eigen::Isometry3d& X_BL = c.X_BL(row, link - 1);
  if (c.robot().convention == DhConvention::kStandard || link >= c.num_joints()) {
    return X_BL.translation();
  }
  // Rx(alpha) Tx(a) of the row: the twist does not turn the shift.
  const double a = c.robot().joints[static_cast<std::size_t>(link)].a;
  return X_BL * Eigen::Vector3d(a, 0, 0);
}

Twist Bend(const PhysicsContext& c, const MassCase& mass_case, int row, int link) {
  const Eigen::Vector3d start = BeamStart(c, row, link);
  const Eigen::Vector3d end = BeamStart(c, row, link + 1);
  const double length = (end - start).norm();
  const Eigen::Vector3d e = (end - start) / length;
  const Load load = GravityLoad(c, mass_case, row, link + 1, end);
  const Eigen::Vector3d moment = load.moment - e * e.dot(load.moment);
  const Eigen::Vector3d force = load.force - e * e.dot(load.force);
  Twist twist;
  twist.at = end;
  twist.rotation = moment * length + e.cross(force) * (length * length / 2);
  twist.translation =
      force * (length * length * length / 3) + moment.cross(e) * (length * length / 2);
  return twist;
}

class LinkBendingEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    return {"link_bending",
            "a link bends under the weight beyond it",
            "phi = (M L + e x F L^2/2)/EI, delta = (F L^3/3 + M x e L^2/2)/EI",
            "flexibility 1/EI [1/(N m^2)]; without masses flexibility_x_<moment>",
            {},
            "robot.links for 1/EI itself",
            "0.3-2e-6 1/(N m^2) [PHYSICS.md E3]"};
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (std::string wrong = CheckJoint(c, request); !wrong.empty()) return wrong;
    const int link = JointIndex(request);
    if (c.num_rows() == 0) return "there are no rows";
    const double length = (BeamStart(c, 0, link + 1) - BeamStart(c, 0, link)).norm();
    if (length < kShortestBeam) return fmt::format("the link is only {:.2f} m long", length);
    if (link + 1 >= c.num_joints()) return "nothing but the payload lies beyond the link";
    return GravityLoads(c, FirstLoadedJoint(c) < 0 ? 0 : link + 1) || HasLoad(c, link)
               ? ""
               : "gravity does not load this link";
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const int link = JointIndex(request);
    std::vector<EffectColumn> columns;
    for (const MassCase& mass_case : MassCases(c, link)) {
      const bool known = mass_case.name.empty();
      columns.push_back(Column(c,
                               mass_case,
                               link,
                               known ? "flexibility" : "flexibility_x_" + mass_case.name,
                               known ? "1/(N m^2)" : "1/(N m^2) " + mass_case.unit));
      columns.back().positive = known;
    }
    return columns;
  }

  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests = EveryJoint(c, "link_bending");
    // The column (link 1) stands; what bends it tilts it, as base_compliance does.
    if (!requests.empty()) requests.erase(requests.begin());
    return requests;
  }

  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {JointIndex(request) == FirstLoadedJoint(c) ? "C1" : "elastic",
            fmt::format("link {}", request.joint),
            "gravity torque"};
  }
  bool DependsOnPoseOnly(const EffectRequest& /*request*/) const override { return true; }

  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue flexibility = Find(values, "flexibility");
    if (flexibility.sigma <= 0) {
      return fmt::format(
          "link {} bends under the weight beyond it (its masses are not known, so "
          "only products with the flexibility are)",
          request.joint);
    }
    return fmt::format("link {} bends under the weight beyond it: 1/EI = {}",
                       request.joint,
                       Quantity(flexibility, 1e-6, "x 1e-6 1/(N m^2)"));
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "link_bending";
    example.request.joint = 2;
    example.request.values["flexibility"] = 1e-6;
    example.row = 0;
    example.slot = "base_ry";
    // Row 0: 40 kg beyond link 2, all horizontal: 3 links... see the header of worked_example.h.
    // F = -400 N along z at L = 0.65 m; M about y = +100 N x (0.155 x 4) m = 62 N m.
    // phi_y = (62 x 0.65 + 400 x 0.65^2 / 2) x 1e-6 = (40.3 + 84.5) x 1e-6.
    example.expected = 124.8e-6;
    return example;
  }

 private:
  static bool HasLoad(const PhysicsContext& c, int link) { return GravityLoads(c, link); }

  static EffectColumn Column(const PhysicsContext& c,
                             const MassCase& mass_case,
                             int link,
                             const std::string& name,
                             const std::string& unit) {
    return TwistColumn(c, name, unit, kTypicalBending * mass_case.typical, [&](int row) {
      return Bend(c, mass_case, row, link);
    });
  }
};

}  // namespace

const Effect& LinkBending() {
  static const LinkBendingEffect effect;
  return effect;
}

}  // namespace dhcal
