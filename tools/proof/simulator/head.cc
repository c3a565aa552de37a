#include "tools/proof/simulator/head.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <glog/logging.h>

#include "core/base/units.h"
#include "tools/proof/simulator/arm_yaml.h"
#include "tools/proof/simulator/screw.h"
#include "tools/proof/simulator/truth.h"
#include "tools/proof/simulator/visibility.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStandOff = 0.06;        // [m] of the tool over the face
constexpr double kTilt = 25 * kDegree;    // of the tool, about its x and y
constexpr double kRulerBegins = 0.317;    // [m] what the ruler says at a placement's middle
constexpr double kMiddleOfLasers = 0.07;  // [m]
constexpr double kSecondsOfPose = 40;
constexpr double kSmallStep = 1e-5;  // [rad] or [m], of central differences
constexpr int kMostTries = 2000;

Isometry3d TurnBy(double angle, const Vector3d& axis) {
  return Displacement(angle * axis, Vector3d::Zero());
}

/// Where a sight from `from` along `along` meets z = surface(x): the length [m].
double MeetsAt(const Vector3d& from,
               const Vector3d& along,
               const std::function<double(double x)>& surface) {
  constexpr int kTurns = 30;  // each is a hundred times nearer
  double length = -from.z() / along.z();
  for (int turn = 0; turn < kTurns; ++turn) {
    length = (surface(from.x() + length * along.x()) - from.z()) / along.z();
  }
  return length;
}

double CameraReads(const EdgeHead& head, const HeadFaults& faults, double x) {
  const double mark = (kRulerBegins + x) * (1 + faults.ruler_scale);
  const double ruling = std::round(mark / head.pitch) * head.pitch;
  return ruling + (1 + faults.pixel) * (mark - ruling);
}

Vector3d NumbersAt(const EdgeHead& head, const HeadFaults& faults, const Isometry3d& X_EQ) {
  const auto bow = [&](double x) { return 0.5 * faults.bow * std::pow(x - faults.vertex, 2); };
  const auto flat = [&](double x) { return bow(x); };
  const auto ruled = [&](double x) { return faults.ruled_height + faults.climb * x + bow(x); };
  const Vector3d straight = X_EQ.linear().col(2);
  const Vector3d eye = X_EQ * head.camera;
  Vector3d numbers;
  numbers[0] = CameraReads(head, faults, eye.x() + MeetsAt(eye, straight, ruled) * straight.x());
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3d slant(faults.slant[k].x(), faults.slant[k].y(), 0);
    const Vector3d beam =
        X_EQ.linear() * Displacement(slant, Vector3d::Zero()).linear() * Vector3d::UnitZ();
    const double height = MeetsAt(X_EQ * head.lasers[k], beam, flat);
    const double off = height - kMiddleOfLasers;
    numbers[static_cast<Index>(k) + 1] =
        height + faults.bent[k].x() * off * off + faults.bent[k].y() * off * off * off;
  }
  return numbers;
}

Motion OnePlace(const MatrixXd& q) {
  Motion motion;
  motion.q = q;
  motion.time = VectorXd::Zero(q.rows());
  motion.payload = VectorXd::Zero(q.rows());
  motion.run.assign(static_cast<std::size_t>(q.rows()), 1);
  motion.test.assign(static_cast<std::size_t>(q.rows()), false);
  return motion;
}

/// From one frame to another: shift [m], and turn [rad] about the axes of the base.
Eigen::Matrix<double, 6, 1> Between(const Isometry3d& from, const Isometry3d& to) {
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  Eigen::Matrix<double, 6, 1> both;
  both << to.translation() - from.translation(), turn.angle() * turn.axis();
  return both;
}

/// Joint angles that bring the tool to a frame, near `q`; damped Gauss-Newton.
std::optional<VectorXd> Reach(const Arm& arm, const Isometry3d& wanted, VectorXd q) {
  constexpr int kMostSteps = 40;
  constexpr double kNear = 1e-9, kDamping = 1e-6, kLongest = 0.3;
  const Physics rigid(arm.num_joints());
  const Index n = q.size();
  for (int step = 0; step < kMostSteps; ++step) {
    MatrixXd rows = q.transpose().replicate(n + 1, 1);
    for (Index j = 0; j < n; ++j) rows(j + 1, j) += kSmallStep;
    const std::vector<Isometry3d> poses = TruePoses(arm, rigid, OnePlace(rows));
    const VectorXd missing = Between(poses[0], wanted);
    if (missing.norm() < kNear) return q;
    MatrixXd J(6, n);
    for (Index j = 0; j < n; ++j) {
      J.col(j) = Between(poses[0], poses[static_cast<std::size_t>(j) + 1]) / kSmallStep;
    }
    const MatrixXd normal = J.transpose() * J + kDamping * MatrixXd::Identity(n, n);
    VectorXd change = normal.ldlt().solve(J.transpose() * missing);
    change *= std::min(1.0, kLongest / std::max(change.lpNorm<Eigen::Infinity>(), 1e-12));
    q += change;
  }
  return std::nullopt;
}

bool WithinRange(const Arm& arm, const VectorXd& q) {
  constexpr double kBeyond = 20 * kDegree;
  return ((q - arm.middle).cwiseAbs() - arm.wide).maxCoeff() < kBeyond;
}

/// Joint angles of a run over an edge, near `q` (poses x joints); nothing where the arm cannot
/// follow.
std::optional<MatrixXd> Follow(
    const Arm& arm, const EdgeHead& head, const Isometry3d& edge, MatrixXd q, Rng* rng) {
  const auto poses = static_cast<int>(q.rows());
  for (int k = 0; k < poses; ++k) {
    const double at = head.length * ((k + rng->Uniform(0, 1)) / poses - 0.5);
    const Isometry3d wanted = edge * Eigen::Translation3d(at, 0, kStandOff) *
                              TurnBy(kPi, Vector3d::UnitX()) *
                              TurnBy(rng->Uniform(-kPi / 2, kPi / 2), Vector3d::UnitZ()) *
                              TurnBy(rng->Uniform(-kTilt, kTilt), Vector3d::UnitX()) *
                              TurnBy(rng->Uniform(-kTilt, kTilt), Vector3d::UnitY());
    const std::optional<VectorXd> reached = Reach(arm, wanted, q.row(k).transpose());
    if (!reached || !WithinRange(arm, *reached)) return std::nullopt;
    q.row(k) = reached->transpose();
  }
  return q;
}

/// Columns of central differences of the numbers.
VectorXd Slope(const EdgeHead& head, const MatrixXd& more, const MatrixXd& less) {
  return Stacked(AlikeNoisy(head, more) - AlikeNoisy(head, less)) / (2 * kSmallStep);
}

}  // namespace

Motion AlongEdges(const Arm& arm, const EdgeRuns& runs, EdgeHead* head, Rng* rng) {
  const int poses = runs.poses;
  const Physics rigid(arm.num_joints());
  MatrixXd all(runs.placements * poses, arm.num_joints());
  int filled = 0;
  for (int tries = 0; filled < runs.placements; ++tries) {
    CHECK_LT(tries, kMostTries) << "the arm reaches no edge";
    VectorXd q(arm.num_joints());
    for (Index j = 0; j < q.size(); ++j) {
      q[j] = arm.middle[j] + rng->Uniform(-1, 1) * std::min(arm.wide[j], 1.5 * arm.narrow[j]);
    }
    const Isometry3d X = TruePoses(arm, rigid, OnePlace(q.transpose())).front();
    const Isometry3d edge = X * TurnBy(rng->Uniform(-kPi / 2, kPi / 2), Vector3d::UnitZ()) *
                            Eigen::Translation3d(0, 0, kStandOff) * TurnBy(kPi, Vector3d::UnitX());
    const std::optional<MatrixXd> run =
        Follow(arm, *head, edge, q.transpose().replicate(poses, 1), rng);
    if (!run) continue;
    all.middleRows(static_cast<Index>(filled) * poses, poses) = *run;
    head->placements.push_back(edge);
    ++filled;
  }
  Motion motion = OnePlace(all);
  motion.payload.setConstant(arm.payload);
  for (int k = 0; k < motion.num_poses(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    motion.time[k] = kSecondsOfPose * k;
    motion.run[i] = 1 + k / poses;
    motion.test[i] = k % poses >= poses - runs.tests;
  }
  return motion;
}

MatrixXd HeadNumbers(const EdgeHead& head,
                     const Arm& built,
                     const Physics& physics,
                     const Motion& motion) {
  const std::vector<Isometry3d> poses = TruePoses(built, physics, motion);
  MatrixXd numbers(motion.num_poses(), 3);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Isometry3d& edge = head.placements[static_cast<std::size_t>(motion.run[i]) - 1];
    numbers.row(static_cast<Index>(i)) =
        NumbersAt(head, physics.head, edge.inverse() * poses[i]).transpose();
  }
  return numbers;
}

MatrixXd AlikeNoisy(const EdgeHead& head, MatrixXd numbers) {
  numbers.rightCols(2) *= head.camera_noise / head.laser_noise;
  return numbers;
}

MatrixXd HeadSignatures(const EdgeHead& head,
                        const Arm& drawing,
                        const Arm& built,
                        const Motion& motion) {
  const Physics rigid(built.num_joints());
  const MatrixXd of_arm = GeometrySignatures(drawing, built, motion, [&](const Arm& arm) {
    return AlikeNoisy(head, HeadNumbers(head, arm, rigid, motion));
  });
  const auto placements = static_cast<Index>(head.placements.size());
  MatrixXd all(of_arm.rows(), of_arm.cols() + 3 + 6 * placements);
  all.leftCols(of_arm.cols()) = of_arm;
  Index column = of_arm.cols();
  for (int k = 0; k < 3; ++k) {
    Arm more = built, less = built;
    more.tool = more.tool * TurnBy(kSmallStep, Vector3d::Unit(k));
    less.tool = less.tool * TurnBy(-kSmallStep, Vector3d::Unit(k));
    all.col(column++) =
        Slope(head, HeadNumbers(head, more, rigid, motion), HeadNumbers(head, less, rigid, motion));
  }
  for (std::size_t placement = 0; placement < head.placements.size(); ++placement) {
    for (int k = 0; k < 6; ++k) {
      const Vector3d unit = kSmallStep * Vector3d::Unit(k % 3);
      const Isometry3d by =
          k < 3 ? Displacement(Vector3d::Zero(), unit) : Displacement(unit, Vector3d::Zero());
      EdgeHead more = head, less = head;
      more.placements[placement] = head.placements[placement] * by;
      less.placements[placement] = head.placements[placement] * by.inverse();
      all.col(column++) = Slope(
          head, HeadNumbers(more, built, rigid, motion), HeadNumbers(less, built, rigid, motion));
    }
  }
  return all;
}

std::string HeadYaml(const EdgeHead& head, bool sigma_given) {
  const auto sensor = [&](const char* name, const Vector3d& place, double noise) {
    std::string text = fmt::format("    {}: {{xyz_m: {}", name, YamlList(place));
    if (sigma_given) text += fmt::format(", sigma_mm: {:.6g}", noise / kMillimetre);
    return text + "}\n";
  };
  return "measurement:\n  kind: straight_edge\n  head:\n" +
         sensor("camera", head.camera, head.camera_noise) +
         sensor("laser1", head.lasers[0], head.laser_noise) +
         sensor("laser2", head.lasers[1], head.laser_noise) +
         fmt::format("    pitch_mm: {:.6g}\n", head.pitch / kMillimetre);
}

}  // namespace dhcal::concealed
