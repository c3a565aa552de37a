#include "core/kinematics/dh_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"

namespace dhcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// What rounding leaves of zero or of a right angle.
constexpr double kRounding = 4e-15;  // [m] or [rad]

/// On a grid of 1e-14 m: -0.5723, not -0.5722999999999999.
double CleanLength(double length) {
  constexpr double kGrid = 1e14;  // [1/m]
  return std::round(length * kGrid) / kGrid + 0.0;
}

double CleanAngle(double angle) {
  const double right = std::round(angle / (kPi / 2)) * (kPi / 2);
  return std::abs(angle - right) < kRounding ? right + 0.0 : angle;
}

/// In (-pi, pi].
double Wrapped(double angle) {
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi + kRounding ? kPi : wrapped;
}

void Clean(JointRow* row) {
  row->theta = CleanAngle(Wrapped(row->theta));
  row->alpha = CleanAngle(Wrapped(row->alpha));
  row->beta = CleanAngle(row->beta);
  row->d = CleanLength(row->d);
  row->a = CleanLength(row->a);
}

Isometry3d CleanFrame(Isometry3d X) {
  X.translation() = X.translation().unaryExpr(&CleanLength).eval();
  if (X.linear().isIdentity(kRounding)) X.linear().setIdentity();
  return X;
}

/// The x axis along the common normal of the z axis and the line through `p` along `u`.
JointRow AlongCommonNormal(const Vector3d& p, const Vector3d& u) {
  constexpr double kTie = 1e-9;  // [rad] theta = +90 and -90 deg are equally small
  const double sine = std::hypot(u.x(), u.y());
  const double along = (p.x() * u.x() + p.y() * u.y()) / sine;
  JointRow row;
  row.theta = std::atan2(u.x(), -u.y());
  row.d = p.z() - u.z() * along / sine;
  row.a = (-p.x() * u.y() + p.y() * u.x()) / sine;
  row.alpha = std::atan2(sine, u.z());
  const double excess = std::abs(row.theta) - kPi / 2;
  if (excess > kTie || (excess > -kTie && row.a < -kTie)) {
    row.theta += kPi;
    row.a = -row.a;
    row.alpha = -row.alpha;
  }
  return row;
}

/// Hayati's form: x towards the point where the line passes the plane z = 0.
JointRow ToNearlyParallel(const Vector3d& p, const Vector3d& u) {
  const Vector3d foot = p - u * (p.z() / u.z());
  JointRow row;
  row.a = std::hypot(foot.x(), foot.y());
  if (row.a < kRounding) {
    row.a = 0;
  } else {
    row.theta = std::atan2(foot.y(), foot.x());
  }
  if (std::abs(row.theta) > kPi / 2 + 1e-9) {
    row.theta = Wrapped(row.theta + kPi);
    row.a = -row.a;
  }
  row.theta = CleanAngle(row.theta);
  const Vector3d turned = Eigen::AngleAxisd(-row.theta, Vector3d::UnitZ()) * u;
  row.beta = std::asin(turned.x());
  row.alpha = std::atan2(-turned.y(), turned.z());
  return row;
}

/// The last row where E's z axis is parallel to the joint's: E's place along the axis and its turn
/// about it.
JointRow AlongAxis(const Isometry3d& X_LE) {
  JointRow row;
  row.theta = std::atan2(X_LE(1, 0), X_LE(0, 0));
  row.d = X_LE.translation().z();
  row.alpha = X_LE(2, 2) < 0 ? kPi : 0;
  return row;
}

double SineToZ(const Vector3d& u) { return std::hypot(u.x(), u.y()); }

JointRow RowTowards(const Vector3d& p, const Vector3d& u) {
  return SineToZ(u) < kNearlyParallel ? ToNearlyParallel(p, u) : AlongCommonNormal(p, u);
}

JointRow LastRow(const Isometry3d& X_LE) {
  const Vector3d u = X_LE.linear().col(2);
  return SineToZ(u) < kNearlyParallel ? AlongAxis(X_LE) : AlongCommonNormal(X_LE.translation(), u);
}

/// On the first axis, its x axis as near to A's as it can be.
Isometry3d BaseOn(const JointAxis& axis) {
  constexpr double kTooSteep = 0.9;  // cosine
  const Vector3d z = axis.z_A.normalized();
  const Vector3d near = std::abs(z.x()) > kTooSteep ? Vector3d::UnitY() : Vector3d::UnitX();
  const Vector3d x = (near - z * z.dot(near)).normalized();
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.linear() << x, z.cross(x), z;
  X_AB.translation() = axis.p_A - z * z.dot(axis.p_A);
  return CleanFrame(X_AB);
}

/// The pose that a standard row makes with its joint at zero.
Isometry3d PoseOf(const JointRow& row) {
  RobotModel robot;
  robot.joints = {row};
  return DhChain(robot).LinkFrames(Eigen::VectorXd::Zero(1)).back();
}

std::vector<JointAxis> AxesOf(const RobotModel& standard) {
  const std::vector<Isometry3d> X_BL =
      DhChain(standard).LinkFrames(Eigen::VectorXd::Zero(standard.num_joints()));
  std::vector<JointAxis> axes;
  for (std::size_t j = 0; j < standard.joints.size(); ++j) {
    axes.push_back({standard.joints[j].type, X_BL[j].translation(), X_BL[j].linear().col(2)});
  }
  return axes;
}

}  // namespace

RowsOfAxes StandardRows(const std::vector<JointAxis>& axes, const Isometry3d& X_AE) {
  RowsOfAxes result;
  if (axes.empty()) {
    result.X_TE = X_AE;
    return result;
  }
  result.X_AB = BaseOn(axes.front());
  // Each row starts from where the numbers before it lead, so that their rounding does not add up.
  Isometry3d X_AL = result.X_AB;
  for (std::size_t j = 0; j < axes.size(); ++j) {
    const Isometry3d X_LA = X_AL.inverse();
    JointRow row = j + 1 < axes.size()
                       ? RowTowards(X_LA * axes[j + 1].p_A, X_LA.linear() * axes[j + 1].z_A)
                       : LastRow(X_LA * X_AE);
    row.type = axes[j].type;
    Clean(&row);
    X_AL = X_AL * PoseOf(row);
    result.rows.push_back(row);
  }
  result.X_TE = CleanFrame(X_AL.inverse() * X_AE);
  return result;
}

RobotModel WithNearNormals(const RobotModel& robot) {
  RobotModel standard = InConvention(robot, DhConvention::kStandard);
  bool far = false;
  for (std::size_t j = 0; j + 1 < standard.joints.size(); ++j) {
    const JointRow& row = standard.joints[j];
    const double cosine = std::cos(row.alpha) * std::cos(row.beta);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    far = far || (row.beta == 0 && row.alpha != 0 && sine < kNearlyParallel);
  }
  if (!far) return robot;
  const Isometry3d X_BT =
      DhChain(standard).LinkFrames(Eigen::VectorXd::Zero(standard.num_joints())).back();
  const RowsOfAxes anew = StandardRows(AxesOf(standard), X_BT);
  for (std::size_t j = 0; j < standard.joints.size(); ++j) {
    JointRow& row = standard.joints[j];
    row.theta = anew.rows[j].theta;
    row.d = anew.rows[j].d;
    row.a = anew.rows[j].a;
    row.alpha = anew.rows[j].alpha;
    row.beta = anew.rows[j].beta;
  }
  FoldIntoEnds(anew.X_AB, anew.X_TE, &standard);
  return InConvention(standard, robot.convention);
}

}  // namespace dhcal
