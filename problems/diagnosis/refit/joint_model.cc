#include "problems/diagnosis/refit/joint_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "problems/diagnosis/hypotheses/library.h"
#include "problems/diagnosis/tuning.h"
#include "problems/start.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPerLink = 4;           // mass, centre's x, y, z
constexpr double kLightest = 0.02;    // of its nominal mass: no link weighs less
constexpr double kHeaviestLink = 20;  // [kg] of a guess
constexpr double kLighterBy = 0.6;    // from link to link

/// Usual masses of an arm, each in the middle of its link.
std::vector<LinkMass> GuessedLinks(const RobotModel& robot) {
  std::vector<LinkMass> links;
  double mass = kHeaviestLink;
  for (std::size_t k = 0; k < robot.joints.size(); ++k, mass *= kLighterBy) {
    LinkMass link;
    link.mass = mass;
    if (robot.convention == DhConvention::kStandard) {
      link.p_LC.x() = -robot.joints[k].a / 2;
    } else if (k + 1 < robot.joints.size()) {
      link.p_LC.x() = robot.joints[k + 1].a / 2;
    }
    links.push_back(link);
  }
  return links;
}

/// The user's problem with every geometric freedom, and only the effects that are held.
ProblemSpec WholeSpec(const ProblemSpec& user) {
  ProblemSpec spec = user;
  spec.parameters.estimate = {"complete"};
  spec.parameters.fix.clear();
  spec.parameters.prior_sigma.clear();
  spec.parameters.effects.clear();
  for (const EffectRequest& effect : user.parameters.effects) {
    if (effect.held) spec.parameters.effects.push_back(effect);
  }
  spec.solver.loss = LossKind::kNone;
  spec.solver.rule = TruncationRule::kNoise;
  spec.solver.kappa = std::min(spec.solver.kappa, 1e-9);
  if (spec.robot.links.empty()) spec.robot.links = GuessedLinks(spec.robot);
  return spec;
}

VectorXd PriorsOf(const std::vector<Parameter>& parameters) {
  VectorXd prior(static_cast<Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    const bool frame = p.group == ParameterGroup::kBase || p.group == ParameterGroup::kTool;
    prior[static_cast<Index>(k)] = frame                     ? kTuning.prior_frame
                                   : p.unit == Unit::kRadian ? kTuning.prior_angle
                                                             : kTuning.prior_length;
  }
  return prior;
}

}  // namespace

int JointRows::FirstColumn(std::size_t member) const {
  int first = 0;
  for (std::size_t k = 0; k < member; ++k) first += state.members[k].item.size;
  return first;
}

JointModel::JointModel(const ProblemSpec& user, const Recording& recording)
    : spec_(WholeSpec(user)),
      masses_given_(!user.robot.links.empty()),
      calibration_(std::make_unique<Calibration>(spec_, recording)),
      prior_(PriorsOf(calibration_->parameters)) {
  for (const EffectRequest& effect : user.parameters.effects) {
    if (!effect.held) given_.push_back(effect);
  }
  calibration_->frames = AlignedFrames(user, recording);
  calibration_->UpdateEffects();
}

std::vector<int> JointModel::AllUnknowns() const {
  std::vector<int> all(calibration_->parameters.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

JointState JointModel::Start() const {
  JointState state;
  const auto unknowns = static_cast<Index>(calibration_->parameters.size());
  state.geometry = VectorXd::Zero(unknowns);
  state.masses = VectorXd::Zero(Index{kPerLink} * spec_.robot.num_joints());
  if (given_.empty()) return state;
  const PhysicsContext context = calibration_->Context();
  for (const EffectRequest& request : given_) {
    Member member;
    member.item = NamedItem(context, request, 1);
    member.value = VectorXd::Zero(member.item.size);
    member.given = true;
    state.members.push_back(std::move(member));
  }
  return state;
}

RobotModel JointModel::WithMasses(const VectorXd& errors) const {
  RobotModel robot = spec_.robot;
  const double mass = masses_given_ ? kTuning.mass_error : kTuning.guessed_mass;
  const double centre = masses_given_ ? kTuning.centre_error : kTuning.guessed_centre;
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    const auto first = static_cast<Index>(k) * kPerLink;
    robot.links[k].mass *= std::max(kLightest, 1 + mass * errors[first]);
    robot.links[k].p_LC += centre * errors.segment<3>(first + 1);
  }
  return robot;
}

MatrixXd JointModel::GeometryDeltas(const VectorXd& geometry) const {
  const Calibration& c = *calibration_;
  MatrixXd deltas = MatrixXd::Zero(c.chain.slots().size(), c.recording.num_rows());
  for (int row = 0; row < c.recording.num_rows(); ++row) {
    const RowLabels labels = c.Labels(row);
    for (std::size_t k = 0; k < c.parameters.size(); ++k) {
      if (c.parameters[k].scope.Holds(labels)) {
        deltas(c.parameters[k].slot, row) += geometry[static_cast<Index>(k)];
      }
    }
  }
  for (const SlotWeights& held : c.held) deltas.row(held.slot) += held.weight.transpose();
  return deltas;
}

JointModel::Bent JointModel::Bend(JointState* state) const {
  Bent bent;
  bent.elastic = std::any_of(
      state->members.begin(), state->members.end(), [](const Member& m) { return m.item.elastic; });
  // Masses that a member which has gone had asked for would load what is tried in its place.
  if (!bent.elastic) state->masses.setZero();
  bent.robot = std::make_shared<const RobotModel>(WithMasses(state->masses));
  const MatrixXd geometry = GeometryDeltas(state->geometry);
  const std::vector<Eigen::Isometry3d> bases = calibration_->BasesAt(state->geometry);
  if (state->deltas.size() == 0) state->deltas = geometry;
  bent.columns.resize(state->members.size());
  for (int turn = 0; turn < (bent.elastic ? kBends : 1); ++turn) {
    bent.context = std::make_shared<const PhysicsContext>(
        *bent.robot, calibration_->recording, bases, state->deltas);
    state->deltas = geometry;
    for (std::size_t k = 0; k < state->members.size(); ++k) {
      const Member& member = state->members[k];
      bent.columns[k] = ColumnsOf(member.item, *bent.context);
      for (int i = 0; i < member.item.size; ++i) {
        for (const SlotWeights& w : bent.columns[k][static_cast<std::size_t>(i)]) {
          state->deltas.row(w.slot) += member.value[i] * w.weight.transpose();
        }
      }
    }
  }
  return bent;
}

VectorXd JointModel::ResidualsAt(JointState state, const RowChoice& choice) const {
  Bend(&state);
  return DesignRows(*calibration_, state.deltas, choice.weights, choice.readings).y();
}

JointRows JointModel::At(JointState state,
                         const RowChoice& choice,
                         const std::vector<int>& free) const {
  const Calibration& c = *calibration_;
  const Bent bent = Bend(&state);
  JointRows joint;
  joint.free = free;
  joint.choice = std::make_shared<const RowChoice>(choice);
  joint.robot = bent.robot;
  joint.context = bent.context;
  joint.rows = std::make_shared<const DesignRows>(c, state.deltas, choice.weights, choice.readings);
  joint.A = joint.rows->Geometry(c.parameters);
  Index size = 0;
  for (const Member& member : state.members) size += member.item.size;
  joint.X.resize(joint.rows->num_rows(), size);
  joint.value.resize(size);
  joint.precision.resize(size);
  Index first = 0;
  for (std::size_t k = 0; k < bent.columns.size(); ++k) {
    const Member& member = state.members[k];
    joint.X.middleCols(first, member.item.size) = joint.rows->Columns(bent.columns[k]);
    joint.value.segment(first, member.item.size) = member.value;
    joint.precision.segment(first, member.item.size) = member.item.precision;
    first += member.item.size;
  }
  joint.state = std::move(state);
  const double rows = std::max(1, joint.rows->degrees_of_freedom());
  joint.phi = std::max(1.0, joint.y().squaredNorm() / rows);
  joint.N.resize(joint.rows->num_rows(), 0);
  if (bent.elastic) AddMassColumns(&joint);
  return joint;
}

void JointModel::AddMassColumns(JointRows* joint) const {
  const Index count = joint->state.masses.size();
  std::vector<VectorXd> columns;
  for (Index k = 0; k < count; ++k) {
    VectorXd errors = joint->state.masses;
    errors[k] += 1;
    const RobotModel heavier = WithMasses(errors);
    const PhysicsContext context(*joint->context, heavier);
    VectorXd column = VectorXd::Zero(joint->rows->num_rows());
    for (std::size_t m = 0; m < joint->state.members.size(); ++m) {
      const Member& member = joint->state.members[m];
      if (!member.item.elastic || member.value.isZero(0)) continue;
      const SlotColumns changed = ColumnsOf(member.item, context);
      const int first = joint->FirstColumn(m);
      for (int i = 0; i < member.item.size; ++i) {
        if (member.value[i] == 0) continue;
        column += member.value[i] * (joint->rows->Column(changed[static_cast<std::size_t>(i)]) -
                                     joint->X.col(first + i));
      }
    }
    if (column.norm() < 1e-9 * std::max(1.0, joint->y().norm())) continue;
    columns.push_back(std::move(column));
    joint->mass_idx.push_back(static_cast<int>(k));
  }
  joint->N.resize(joint->rows->num_rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    joint->N.col(static_cast<Index>(k)) = columns[k];
  }
}

}  // namespace dhcal
