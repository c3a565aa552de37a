#include "core/physics/gravity.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/base/units.h"

namespace dhcal {
namespace {

constexpr double kTypicalMass = 20.0, kTypicalMoment = 10.0;
constexpr double kTypicalWristMass = 4.0, kTypicalWristMoment = 0.5;
constexpr double kSmallestTorque = 1.0;  // [N m] spread that counts as a load, of 10 kg links
constexpr int kBasisPoses = 120;
constexpr double kRankTolerance = 1e-9;
const char* const kAxisNames[] = {"x", "y", "z"};

MassCase Empty(const PhysicsContext& context) {
  MassCase mass_case;
  mass_case.mass.setZero(context.num_joints() + 1);
  mass_case.moment.setZero(3, context.num_joints() + 1);
  return mass_case;
}

MassCase OwnMasses(const PhysicsContext& context) {
  MassCase own = Empty(context);
  const int n = context.num_joints();
  for (int i = 0; i < n; ++i) {
    const LinkMass& link = context.robot().links[static_cast<std::size_t>(i)];
    own.mass[i] = link.mass;
    own.moment.col(i) = link.mass * link.p_LC;
  }
  // Body n is per kilogram carried.
  own.mass[n] = 1;
  own.moment.col(n) = context.robot().payload.p_LC;
  own.payload_of_row = true;
  return own;
}

/// Ten kilograms on every link, one moment ahead: enough to see which joints carry at all.
MassCase AnyMasses(const PhysicsContext& context) {
  MassCase any = Empty(context);
  any.mass.setConstant(10);
  any.moment.setConstant(1);
  return any;
}

/// Unit masses and moments of all links beyond a joint.
std::vector<MassCase> UnitCases(const PhysicsContext& context, int joint) {
  std::vector<MassCase> cases;
  for (int link = joint; link < context.num_joints(); ++link) {
    for (int axis = 0; axis < 3; ++axis) {
      MassCase moment = Empty(context);
      moment.name = fmt::format("link{}_{}", link + 1, kAxisNames[axis]);
      moment.unit = "kg m";
      moment.typical = link < 3 ? kTypicalMoment : kTypicalWristMoment;
      moment.moment(axis, link) = 1;
      cases.push_back(moment);
    }
    MassCase mass = Empty(context);
    mass.name = fmt::format("link{}_mass", link + 1);
    mass.unit = "kg";
    mass.typical = link < 3 ? kTypicalMass : kTypicalWristMass;
    mass.mass[link] = 1;
    cases.push_back(mass);
  }
  return cases;
}

/// Independent cases among the unit ones, judged on poses all over the joint space so that the
/// choice does not depend on the recording.
std::vector<MassCase> MinimalCases(const PhysicsContext& context, int joint) {
  Rng rng(20260);
  Recording anywhere;
  anywhere.q.resize(kBasisPoses, context.num_joints());
  for (Eigen::Index k = 0; k < anywhere.q.rows(); ++k) {
    for (Eigen::Index j = 0; j < anywhere.q.cols(); ++j) {
      anywhere.q(k, j) =
          context.revolute(static_cast<int>(j)) ? rng.Uniform(-kPi, kPi) : rng.Uniform(-0.5, 0.5);
    }
  }
  const PhysicsContext poses(context.robot(), anywhere, {Eigen::Isometry3d::Identity()});
  const std::vector<MassCase> all = UnitCases(context, joint);
  Eigen::MatrixXd torques(kBasisPoses, static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    torques.col(static_cast<Eigen::Index>(k)) = GravityTorque(poses, all[k], joint);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(torques);
  qr.setThreshold(kRankTolerance);
  std::vector<MassCase> minimal;
  for (Eigen::Index k = 0; k < qr.rank(); ++k) {
    minimal.push_back(all[static_cast<std::size_t>(qr.colsPermutation().indices()[k])]);
  }
  return minimal;
}

}  // namespace

Load GravityLoad(const PhysicsContext& context,
                 const MassCase& mass_case,
                 int row_idx,
                 int first_body,
                 const Eigen::Vector3d& point) {
  const Eigen::Vector3d& g = context.robot().gravity_B;
  const int n = context.num_joints();
  Load load;
  for (int body = first_body; body <= n; ++body) {
    const double scale = body == n && mass_case.payload_of_row ? context.payload(row_idx) : 1.0;
    const double mass = scale * mass_case.mass[body];
    const Eigen::Vector3d moment = scale * mass_case.moment.col(body);
    if (mass == 0 && moment.isZero(0)) continue;
    const Eigen::Isometry3d& X_BL = context.X_BL(row_idx, body == n ? n - 1 : body);
    load.force += mass * g;
    load.moment += (mass * (X_BL.translation() - point) + X_BL.linear() * moment).cross(g);
  }
  return load;
}

Eigen::VectorXd GravityTorque(const PhysicsContext& context, const MassCase& mass_case, int joint) {
  Eigen::VectorXd torque(context.num_rows());
  for (int k = 0; k < context.num_rows(); ++k) {
    const Load load = GravityLoad(context, mass_case, k, joint, context.axis_point(k, joint));
    const Eigen::Vector3d axis = context.axis(k, joint);
    torque[k] = axis.dot(context.revolute(joint) ? load.moment : load.force);
  }
  return torque;
}

std::vector<MassCase> MassCases(const PhysicsContext& context, int joint) {
  if (!context.robot().links.empty()) return {OwnMasses(context)};
  return FreeMassCases(context, joint);
}

std::vector<MassCase> FreeMassCases(const PhysicsContext& context, int joint) {
  std::vector<MassCase> cases = MinimalCases(context, joint);
  if (context.payload_varies()) {
    MassCase carried = Empty(context);
    const int n = context.num_joints();
    carried.mass[n] = 1;
    carried.moment.col(n) = context.robot().payload.p_LC;
    carried.payload_of_row = true;
    // First: its parameter is the compliance itself, the mass being known.
    cases.insert(cases.begin(), carried);
  }
  return cases;
}

MassCase OneMoment(const PhysicsContext& context, int link, double angle) {
  // A link's x stands across the axis of its joint in both conventions.
  const Eigen::Vector3d axis = context.X_BL(0, link).linear().transpose() * context.axis(0, link);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  MassCase one = Empty(context);
  one.moment.col(link) = std::cos(angle) * x + std::sin(angle) * axis.cross(x);
  return one;
}

bool HasMeasuredTorque(const PhysicsContext& context, int joint) {
  const Eigen::MatrixXd& torque = context.recording().torque;
  return torque.rows() > 0 && torque.col(joint).allFinite();
}

Eigen::VectorXd MeasuredLoad(const PhysicsContext& context, int joint) {
  Eigen::VectorXd drive = -context.sign(joint) * context.recording().torque.col(joint);
  if (!GravityLoads(context, joint)) return drive;
  const Eigen::VectorXd gravity = GravityTorque(context, AnyMasses(context), joint);
  const double covariance =
      (drive.array() - drive.mean()).matrix().dot((gravity.array() - gravity.mean()).matrix());
  if (covariance < 0) drive = -drive;
  return drive;
}

bool GravityLoads(const PhysicsContext& context, int joint) {
  const Eigen::VectorXd torque = GravityTorque(context, AnyMasses(context), joint);
  if (torque.size() == 0) return false;
  return torque.maxCoeff() - torque.minCoeff() > kSmallestTorque;
}

int FirstLoadedJoint(const PhysicsContext& context) {
  for (int joint = 0; joint < context.num_joints(); ++joint) {
    if (GravityLoads(context, joint)) return joint;
  }
  return -1;
}

double SoftnessOfSize(const PhysicsContext& c) {
  constexpr double kUsualTorque = 100;   // [N m] at the shoulder
  constexpr double kSmallestArm = 1e-3;  // of it
  const int shoulder = FirstLoadedJoint(c);
  if (c.robot().links.empty() || shoulder < 0 || !c.revolute(shoulder)) return 1;
  const double torque =
      GravityTorque(c, MassCases(c, shoulder).front(), shoulder).cwiseAbs().maxCoeff();
  return kUsualTorque / std::clamp(torque, kSmallestArm * kUsualTorque, kUsualTorque);
}

}  // namespace dhcal
