#include "tools/study/scenarios.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/physics/registry.h"
#include "residuals/registry.h"

namespace dhcal {
namespace {

struct Table {
  double d, a, alpha_deg, mass;
  Eigen::Vector3d com;
};

RobotModel RobotOf(const std::vector<Table>& rows, const std::string& name) {
  RobotModel robot;
  robot.name = name;
  for (const Table& row : rows) {
    JointRow joint;
    joint.d = row.d;
    joint.a = row.a;
    joint.alpha = row.alpha_deg * kDegree;
    robot.joints.push_back(joint);
    robot.links.push_back({row.mass, row.com});
  }
  robot.X_TQ.translation() = Eigen::Vector3d(0.05, 0.02, 0.2);
  robot.payload = {10.0, Eigen::Vector3d(0.05, 0, 0.12)};
  return robot;
}

RobotModel Kr15() {
  return RobotOf({{0.675, 0.3, 90, 60, {-0.2, 0.1, 0}},
                  {0, 0.65, 0, 40, {-0.35, 0, 0.05}},
                  {0, 0.155, 90, 35, {-0.02, 0, 0.1}},
                  {0.6, 0, -90, 15, {0, 0.15, 0}},
                  {0, 0, 90, 8, {0, 0, 0.03}},
                  {0.14, 0, 0, 3, {0, 0, -0.03}}},
                 "KUKA KR 15-like");
}

RobotModel Ur10() {
  return RobotOf({{0.1273, 0, 90, 7.778, {0, 0, 0}},
                  {0, -0.612, 0, 12.93, {0.3, 0, 0.15}},
                  {0, -0.5723, 0, 3.87, {0.27, 0, 0.06}},
                  {0.163941, 0, 90, 1.96, {0, 0, 0}},
                  {0.1157, 0, -90, 1.96, {0, 0, 0}},
                  {0.0922, 0, 0, 0.202, {0, 0, 0}}},
                 "Universal Robots UR10");
}

Eigen::MatrixXd Poses(const Scenario& s, Rng* rng) {
  const double wide[] = {170, 80, 100, 170, 110, 170}, narrow[] = {35, 20, 20, 60, 30, 90};
  const double middle[] = {0, 20, -10, 0, 30, 0};
  Eigen::MatrixXd q(s.poses, 6);
  for (int k = 0; k < s.poses; ++k) {
    for (int j = 0; j < 6; ++j) {
      const double half = s.narrow ? narrow[j] : wide[j];
      q(k, j) = rng->Uniform(middle[j] - half, middle[j] + half) * kDegree;
    }
    if (s.planar) q(k, 0) = q(k, 3) = q(k, 5) = 0;
  }
  return q;
}

Eigen::VectorXd GeometryErrors(const SlotLayout& slots, Rng* rng) {
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(slots.size());
  for (int j = 0; j < slots.num_joints(); ++j) {
    delta[slots.joint(j, JointSlot::kTheta)] = 3e-3 * rng->Normal();
    delta[slots.joint(j, JointSlot::kAlpha)] = 1e-3 * rng->Normal();
    delta[slots.joint(j, JointSlot::kD)] = 0.3e-3 * rng->Normal();
    delta[slots.joint(j, JointSlot::kA)] = 0.3e-3 * rng->Normal();
  }
  delta[slots.joint(1, JointSlot::kBeta)] = 0.4e-3 * rng->Normal();
  return delta;
}

Eigen::MatrixXd EffectDeltas(const PhysicsContext& context, const Scenario& s) {
  Eigen::MatrixXd delta = Eigen::MatrixXd::Zero(context.slots().size(), context.num_rows());
  for (const EffectRequest& request : s.truth) {
    for (const EffectColumn& column : EffectColumns(context, request)) {
      const auto value = request.values.find(column.parameter);
      if (value == request.values.end()) continue;
      for (const SlotWeights& weights : column.slots) {
        delta.row(weights.slot) += value->second * weights.weight.transpose();
      }
    }
  }
  return delta;
}

void SpoilMasses(Rng* rng, RobotModel* robot) {
  for (LinkMass& link : robot->links) {
    link.mass *= 1 + 0.3 * rng->Normal() / 1.5;
    link.mass = std::max(link.mass, 0.1);
    for (int k = 0; k < 3; ++k) link.p_LC[k] += 0.03 * rng->Normal();
  }
  robot->payload.mass -= 2;
}

void AddNulls(std::vector<Scenario>* all) {
  const auto add = [&](Scenario s, const std::string& name) {
    s.name = name;
    s.group = "null";
    all->push_back(std::move(s));
  };
  Scenario plain;
  add(plain, "KR 15, wide, 100 poses");
  Scenario narrow = plain;
  narrow.narrow = true;
  add(narrow, "KR 15, narrow, 100 poses");
  Scenario many = plain;
  many.poses = 660;
  add(many, "KR 15, wide, 660 poses (2,000 rows)");
  Scenario few = plain;
  few.poses = 40;
  few.sigma_known = false;
  add(few, "KR 15, wide, 40 poses, sigma unknown");
  Scenario unknown = plain;
  unknown.sigma_known = false;
  add(unknown, "KR 15, wide, 100 poses, sigma unknown");
  Scenario ur10 = unknown;
  ur10.ur10 = true;
  ur10.poses = 200;
  add(ur10, "UR10, wide, 200 poses, sigma unknown");
  Scenario differences = plain;
  differences.kind = "adjacent_position";
  add(differences, "KR 15, differences read afresh");
  differences.noise = NoiseKind::kSharedPose;
  add(differences, "KR 15, differences of shared readings");
  Scenario runs = differences;
  runs.runs = 25;
  runs.sigma_known = false;
  add(runs, "KR 15, differences of shared readings in 25 runs, sigma unknown");
  Scenario planar = plain;
  planar.planar = true;
  add(planar, "KR 15, all poses in one plane");
  Scenario outliers = plain;
  outliers.poses = 200;
  outliers.outliers = 0.02;
  add(outliers, "KR 15, 2 % outliers of ten times the noise");
  outliers.sigma_known = false;
  add(outliers, "KR 15, 2 % outliers, sigma unknown");
}

void AddSingles(std::vector<Scenario>* all) {
  std::vector<EffectRequest> effects = {
      Request("joint_compliance", 2, {{"compliance", 3e-6}}),
      Request("joint_compliance", 3, {{"compliance", 4e-6}}),
      Request("joint_compliance", 4, {{"compliance", 30e-6}}),
      Request("joint_compliance", 5, {{"compliance", 30e-6}}),
      Request("gravity_balancer", 2, {{"sin_1", 2e-4}, {"cos_1", 1e-4}, {"sin_2", 1e-4}}),
      Request("link_bending", 2, {{"flexibility", 1e-6}}),
      Request("base_compliance", 0, {{"compliance_x", 3e-7}, {"compliance_y", 3e-7}}),
      Request("joint_gain", 1, {{"gain", 1e-4}}),
      Request("joint_gain", 4, {{"gain", 2e-4}}),
      Request("joint_coupling", 5, {{"coupling", 2e-4}}, {{"driver_joint", 4}}),
      Request("joint_coupling", 6, {{"coupling", 2e-4}}, {{"driver_joint", 4}}),
      Request("tool_step", 0, {{"x", 1e-4}}, {{"at_row", 60}}),
      Request("joint_step", 2, {{"step", 2e-4}}, {{"at_row", 45}}),
      Request("joint_step", 4, {{"step", 2e-4}}, {{"at_row", 45}}),
      Request("axis_wobble", 4, {{"x", 3e-5}, {"y", 3e-5}}, {{"order", 2}})};
  for (const int joint : {1, 2, 3}) {
    effects.push_back(Request("gear_harmonic", joint, {{"sin_1", 1e-4}}, {{"order", 1}}));
    effects.push_back(Request("gear_harmonic", joint, {{"sin_2", 7e-5}}, {{"order", 2}}));
    effects.push_back(Request("gear_harmonic", joint, {{"sin_121", 7e-5}}, {{"order", 121}}));
  }
  for (const int joint : {1, 2, 3})
    effects.push_back(Request("backlash", joint, {{"width", 1.4e-4}}));
  for (const int joint : {4, 5}) effects.push_back(Request("backlash", joint, {{"width", 3e-4}}));
  for (const EffectRequest& effect : effects) {
    Scenario s;
    s.name = InstanceName(effect);
    s.group = "single";
    s.truth = {effect};
    all->push_back(s);
  }
}

void AddSeveral(std::vector<Scenario>* all) {
  const EffectRequest c2 = Request("joint_compliance", 2, {{"compliance", 3e-6}});
  const EffectRequest backlash4 = Request("backlash", 4, {{"width", 3e-4}});
  const EffectRequest line3 = Request("gear_harmonic", 3, {{"sin_121", 7e-5}}, {{"order", 121}});
  const EffectRequest coupling =
      Request("joint_coupling", 5, {{"coupling", 2e-4}}, {{"driver_joint", 4}});
  const EffectRequest step = Request("joint_step", 3, {{"step", 2e-4}}, {{"at_row", 45}});
  const EffectRequest twice1 = Request("gear_harmonic", 1, {{"sin_2", 1e-4}}, {{"order", 2}});
  const std::vector<std::vector<EffectRequest>> sets = {{c2, backlash4},
                                                        {c2, line3},
                                                        {coupling, step},
                                                        {c2, backlash4, twice1},
                                                        {step, line3, coupling}};
  for (const auto& set : sets) {
    Scenario s;
    for (const EffectRequest& effect : set)
      s.name += (s.name.empty() ? "" : " + ") + InstanceName(effect);
    s.group = "several";
    s.truth = set;
    all->push_back(s);
  }
}

void AddOutside(std::vector<Scenario>* all) {
  const auto add = [&](const std::string& name, const std::string& slot, auto function) {
    Scenario s;
    s.name = name;
    s.group = "outside";
    s.outside_slot = slot;
    s.outside = function;
    all->push_back(s);
  };
  add("damaged tooth of joint 3 (10 deg wide, 0.4 mrad)",
      "theta3",
      [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
        const double x = (c.recording().q(row, 2) / kDegree - 15) / 10;
        (*delta)[c.slots().joint(2, JointSlot::kTheta)] += 0.4e-3 * std::exp(-0.5 * x * x);
      });
  add("kink of joint 2, 0.5 mrad/rad |q2 - 40 deg|",
      "theta2",
      [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
        (*delta)[c.slots().joint(1, JointSlot::kTheta)] +=
            0.5e-3 * std::abs(c.recording().q(row, 1) - 40 * kDegree);
      });
  add("cable pull on joint 5, 0.15 mrad q4 q6",
      "theta5",
      [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
        (*delta)[c.slots().joint(4, JointSlot::kTheta)] +=
            0.15e-3 * c.recording().q(row, 3) * c.recording().q(row, 5);
      });
  add("unlisted coupling, joint 1 turns joint 3 by 0.2 mrad sin 2 q1",
      "theta3",
      [](const PhysicsContext& c, int row, Eigen::VectorXd* delta) {
        (*delta)[c.slots().joint(2, JointSlot::kTheta)] +=
            0.2e-3 * std::sin(2 * c.recording().q(row, 0));
      });
}

void AddMasses(std::vector<Scenario>* all) {
  Scenario s;
  s.name = "joint_compliance at joint 2, masses off by 30 %, payload by 2 kg";
  s.group = "masses";
  s.truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  s.wrong_masses = true;
  all->push_back(s);
}

}  // namespace

EffectRequest Request(const std::string& effect,
                      int joint,
                      std::map<std::string, double> values,
                      std::map<std::string, double> settings) {
  EffectRequest request;
  request.effect = effect;
  request.joint = joint;
  request.values = std::move(values);
  request.settings = std::move(settings);
  return request;
}

Draw MakeDraw(const Scenario& s, std::uint64_t seed) {
  Rng rng(seed);
  Draw draw;
  const RobotModel robot = s.ur10 ? Ur10() : Kr15();
  const DhChain chain(robot);
  Recording& recording = draw.recording;
  recording.q = Poses(s, &rng);
  const Eigen::VectorXd geometry = GeometryErrors(chain.slots(), &rng);
  const PhysicsContext context(robot, recording, {robot.X_WB});
  const Eigen::MatrixXd physics = EffectDeltas(context, s);
  recording.p_WQ.resize(s.poses, 3);
  for (int row = 0; row < s.poses; ++row) {
    Eigen::VectorXd delta = geometry + physics.col(row);
    if (s.outside) s.outside(context, row, &delta);
    const Eigen::Isometry3d X_WQ =
        chain.Pose<double>(recording.q.row(row).transpose(), delta, {robot.X_WB, robot.X_TQ});
    const double size = s.sigma * (rng.Uniform(0, 1) < s.outliers ? 10 : 1);
    for (int k = 0; k < 3; ++k) {
      recording.p_WQ(row, k) = X_WQ.translation()[k] + size * rng.Normal();
    }
  }
  if (KindNamed(s.kind).pairs && s.noise == NoiseKind::kIndependent) {
    // Differences read afresh: each with its own error.
    Eigen::MatrixXd displacement = Eigen::MatrixXd::Constant(s.poses, 3, std::nan(""));
    for (int row = 1; row < s.poses; ++row) {
      displacement.row(row) = recording.p_WQ.row(row) - recording.p_WQ.row(row - 1);
    }
    Rng fresh(seed + 1000000);
    for (int row = 1; row < s.poses; ++row) {
      const auto exact = [&](int r) {
        return chain
            .Pose<double>(recording.q.row(r).transpose(),
                          Eigen::VectorXd(geometry + physics.col(r)),
                          {robot.X_WB, robot.X_TQ})
            .translation();
      };
      const Eigen::Vector3d difference = exact(row) - exact(row - 1);
      for (int k = 0; k < 3; ++k) displacement(row, k) = difference[k] + s.sigma * fresh.Normal();
    }
    recording.displacement = displacement;
    recording.p_WQ.resize(0, 0);
  }
  if (s.runs > 1) {
    for (int run = 0; run < s.runs; ++run) recording.run_names.push_back(std::to_string(run + 1));
    for (int row = 0; row < s.poses; ++row) recording.run_idx.push_back(row * s.runs / s.poses);
  }
  ProblemSpec& spec = draw.spec;
  spec.name = s.name;
  spec.robot = robot;
  if (s.wrong_masses) SpoilMasses(&rng, &spec.robot);
  spec.measurement.kind = KindNamed(s.kind);
  spec.measurement.noise = s.noise;
  if (s.sigma_known) spec.measurement.sigma = s.sigma;
  spec.parameters.estimate = {"complete"};
  return draw;
}

std::vector<Scenario> AllScenarios() {
  std::vector<Scenario> all;
  AddNulls(&all);
  AddSingles(&all);
  AddSeveral(&all);
  AddOutside(&all);
  AddMasses(&all);
  return all;
}

}  // namespace dhcal
