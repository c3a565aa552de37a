// The loop's rows: which are good, what noise they have, and the robust model that starts it.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/math/statistics.h"
#include "problems/diagnosis/hypotheses/bank.h"
#include "problems/diagnosis/judge/certainty.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/rows/moved_by_joint.h"
#include "problems/diagnosis/rows/outliers.h"
#include "problems/diagnosis/tuning.h"
#include "problems/noise.h"
#include "problems/without_rows.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kHuber = 2;  // robust standard deviations of a reading that counts in full
constexpr double kFinestInstrument = 1e-7;  // [m]
constexpr double kNoiseSettled = 0.02;
constexpr double kJointNoiseSettled = 0.1;  // of it
constexpr double kColumnsOfRows = 1.0 / 6;  // at most, of a first model

/// Takes out the members whose item `goes`, but for the problem file's own; returns how many
/// unknowns they had.
template <typename Goes>
double TakeOut(const Goes& goes, JointState* state) {
  double unknowns = 0;
  auto& members = state->members;
  const auto is_out = [&](const Member& member) {
    if (member.given || !goes(member.item)) return false;
    unknowns += member.item.size;
    return true;
  };
  members.erase(std::remove_if(members.begin(), members.end(), is_out), members.end());
  return unknowns;
}

/// What so many unknowns more are worth that leave `with` instead of `without`: twice the logarithm
/// of how much likelier the rows are, less BIC's price.
double WorthOf(double unknowns, const DesignRows& without, const DesignRows& with) {
  return 2.0 * with.num_rows() * std::log(without.y().norm() / with.y().norm()) -
         unknowns * std::log(static_cast<double>(with.num_readings()));
}

/// Mean leverage of each reading in a fit.
VectorXd LeverageOf(const JointModel& model, const JointRows& joint) {
  const Augmented augmented = AugmentedRows(model, joint, joint.N);
  const MatrixXd root = NormalFactor(augmented.B).Whiten(augmented.B.topRows(joint.y().size()));
  const int m = joint.rows->coordinates();
  VectorXd leverage(joint.rows->num_readings());
  for (Index k = 0; k < leverage.size(); ++k) {
    leverage[k] = root.middleRows(k * m, m).squaredNorm() / m;
  }
  return leverage;
}

/// Readings that follow each other without a gap (differences), cut to pieces of a length; single
/// readings are pieces of their own.
std::vector<std::vector<Reading>> PiecesOf(const std::vector<Reading>& readings) {
  constexpr std::size_t kLongest = 100;
  std::vector<std::vector<Reading>> pieces;
  for (const Reading& reading : readings) {
    const bool follows = reading.previous_idx >= 0 && !pieces.empty() &&
                         pieces.back().back().row_idx == reading.previous_idx &&
                         pieces.back().size() < kLongest;
    if (!follows) pieces.emplace_back();
    pieces.back().push_back(reading);
  }
  return pieces;
}

/// Evenly over the recording. Differences are taken in pieces: one torn out of its series would say
/// little, since its own offset is free.
std::vector<Reading> Thinned(const std::vector<Reading>& readings) {
  const auto most = static_cast<std::size_t>(kTuning.most_searched);
  if (readings.size() <= most) return readings;
  const std::vector<std::vector<Reading>> pieces = PiecesOf(readings);
  const std::size_t wanted = std::max<std::size_t>(1, pieces.size() * most / readings.size());
  std::vector<Reading> thinned;
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::vector<Reading>& piece = pieces[k * pieces.size() / wanted];
    thinned.insert(thinned.end(), piece.begin(), piece.end());
  }
  return thinned;
}

std::vector<int> MovingJoints(const PhysicsContext& c) {
  std::vector<int> moving;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (c.moves(joint)) moving.push_back(joint);
  }
  return moving;
}

/// Derivatives by what noise of the joints turns, rows x joints (twice where rows hold two poses).
MatrixXd ByAngles(const Calibration& c, const DesignRows& rows) {
  MatrixXd by_angles = rows.ByJoints();
  for (Index k = 0; k < by_angles.cols(); ++k) {
    const auto joint = static_cast<std::size_t>(k % c.recording.num_joints());
    if (c.spec.robot.joints[joint].type != JointType::kRevolute) by_angles.col(k).setZero();
  }
  return by_angles;
}

/// Joints at the readings of fitted rows and test rows, one behind the other.
std::vector<JointAtReadings> JointsAt(const PhysicsContext& c,
                                      const std::vector<int>& moving,
                                      const DesignRows& fitted,
                                      const DesignRows& test,
                                      const std::vector<int>& rows) {
  std::vector<JointAtReadings> joints;
  for (const int joint : moving) {
    JointAtReadings at;
    at.place = c.q(joint)(rows);
    at.motion.resize(fitted.num_rows() + test.num_rows());
    at.motion << fitted.now().col(c.joint_slot(joint)), test.now().col(c.joint_slot(joint));
    joints.push_back(std::move(at));
  }
  return joints;
}

}  // namespace

std::vector<Reading> Loop::GoodReadings(bool test) const {
  const Calibration& c = model_.calibration();
  return WithoutRows(c, test ? c.readings.test : c.readings.fitted, off_);
}

RowWeights Loop::WeightsOfNoise() const {
  RowWeights weights;
  weights.noise = noise_;
  weights.read_out = in_.read_out;
  weights.joint_noise = joint_noise_;
  return weights;
}

RowChoice Loop::Choice(bool all) const {
  RowChoice choice;
  choice.readings = GoodReadings(false);
  if (!all) choice.readings = Thinned(choice.readings);
  choice.weights = WeightsOfNoise();
  choice.weights.weight = weight_;
  choice.weights.slow = slow_;
  return choice;
}

double Loop::NumPoses() const {
  std::set<int> poses;
  for (const Reading& reading : Thinned(GoodReadings(false))) {
    poses.insert(poses_[static_cast<std::size_t>(reading.row_idx)]);
  }
  return static_cast<double>(poses.size());
}

void Loop::UpdateOutliers(const JointRows& joint, bool with_leverage) {
  const Calibration& c = model_.calibration();
  const RowWeights weights = WeightsOfNoise();
  const DesignRows fitted(c, joint.state.deltas, weights, c.readings.fitted);
  const DesignRows test(c, joint.state.deltas, weights, c.readings.test);
  ReadingResiduals residuals;
  residuals.coordinates = fitted.coordinates();
  residuals.fitted = fitted.y();
  residuals.test = test.y();
  if (with_leverage) {
    const VectorXd own = LeverageOf(model_, joint);
    std::map<int, double> of_row;
    for (int k = 0; k < joint.rows->num_readings(); ++k) {
      of_row[joint.rows->recording_row(k)] = own[k];
    }
    residuals.leverage = VectorXd::Zero(fitted.num_readings());
    for (int k = 0; k < fitted.num_readings(); ++k) {
      const auto found = of_row.find(fitted.recording_row(k));
      if (found != of_row.end()) residuals.leverage[k] = found->second;
    }
  }
  const Outliers outliers = FindOutliers(residuals, in_.sigma_known);
  std::vector<bool> off = outliers.fitted;
  off.insert(off.end(), outliers.test.begin(), outliers.test.end());
  std::vector<int> rows;
  for (const DesignRows* const set : {&fitted, &test}) {
    for (int k = 0; k < set->num_readings(); ++k) rows.push_back(set->recording_row(k));
  }
  // Of two poses no reading says which of them a joint moved.
  std::vector<int> moved(off.size(), -1);
  const std::vector<int> moving = MovingJoints(*joint.context);
  if (!c.measurement->kind().pairs) {
    VectorXd y(fitted.num_rows() + test.num_rows());
    y << fitted.y(), test.y();
    moved = MovedByAJoint(JointsAt(*joint.context, moving, fitted, test, rows), y, off);
  }
  off_.clear();
  moved_.clear();
  for (std::size_t k = 0; k < off.size(); ++k) {
    if (!off[k]) continue;
    off_.insert(rows[k]);
    if (moved[k] >= 0) moved_[rows[k]] = moving[static_cast<std::size_t>(moved[k])];
  }
}

bool Loop::DoubtRounding(const JointRows& joint) {
  Eigen::VectorXd& quantum = in_.read_out.quantum;
  if (quantum.size() == 0 || quantum.isZero(0)) return false;
  RowChoice exact = Choice();
  exact.weights.read_out.quantum.setZero();
  const DesignRows rows(model_.calibration(), joint.state.deltas, exact.weights, exact.readings);
  MatrixXd rounded = rows.ByJoints();
  for (Index k = 0; k < rounded.cols(); ++k) {
    rounded.col(k) *= quantum[k % quantum.size()] / std::sqrt(12.0);
  }
  if (EvidenceOfCovariance(rows.y(), rounded, rows.coordinates()) > -kTuning.noise_evidence) {
    return false;
  }
  quantum.setZero();
  return true;
}

void Loop::DoubtNoise(const JointRows& joint) {
  // Of rows that state their own, none says how much all of them are wrong.
  if (!in_.sigma_known || SourceOfNoise(model_.calibration()).per_row) return;
  const double dof = joint.rows->degrees_of_freedom() - static_cast<double>(joint.free.size()) -
                     static_cast<double>(joint.X.cols());
  const double squares = joint.y().squaredNorm();
  if (!(squares < kTuning.overstated * dof)) return;
  // Less than any instrument's is a simulation without noise, and its rounding no measure.
  if (noise_.sigma * std::sqrt(squares / dof) < kFinestInstrument) return;
  if (ChiSquareTail(squares, dof) < 1 - kTuning.overstated_p) return;
  in_.sigma_known = false;
  overstated_ = true;
}

void Loop::UpdateNoise(const JointRows& joint) {
  if (in_.sigma_known) return;
  const int m = joint.rows->coordinates();
  const double rows = std::max(2, joint.rows->degrees_of_freedom());
  const auto unknowns =
      static_cast<double>(joint.free.size()) + static_cast<double>(joint.X.cols());
  const double share = std::max(rows - unknowns, rows / 4) / rows;
  double lengths = 0, turns = 0;
  for (Index k = 0; k < joint.y().size(); ++k) {
    (k % m < 3 ? lengths : turns) += joint.y()[k] * joint.y()[k];
  }
  const double readings = std::max(1, joint.rows->num_readings());
  const double per_length = lengths / (readings * std::min(m, 3)) / share;
  noise_.sigma *= std::sqrt(std::max(per_length, 1e-12));
  if (m == 6) {
    noise_.sigma_rotation *= std::sqrt(std::max(turns / (readings * 3) / share, 1e-12));
  }
}

bool Loop::UpdateSlowNoise(const JointRows& joint) {
  if (!DesignRows::CanWhiten(model_.calibration()) || in_.readings_per_pose > 1) return false;
  RowChoice plain = Choice();
  plain.weights.slow = SlowNoise();
  const auto left_by = [&](const JointState& state) {
    return DesignRows(model_.calibration(), state.deltas, plain.weights, plain.readings);
  };
  const DesignRows rows = left_by(joint.state);
  const ReadingOrder order = rows.Order();
  LikeliestSlowNoise likeliest = FindSlowNoise(rows.y(), order, slow_);
  JointState timeless = joint.state;
  const double unknowns =
      TakeOut([&](const Item& item) { return IsByTheClock(item, *joint.context); }, &timeless);
  if (unknowns > 0) {
    const DesignRows without =
        left_by(FitJointly(model_, timeless, plain, joint.free, kFarSteps).state);
    const LikeliestSlowNoise instead = FindSlowNoise(without.y(), order, slow_);
    if (instead.evidence > likeliest.evidence + WorthOf(unknowns, without, rows)) {
      likeliest = instead;
    }
  }
  if (likeliest.evidence < kTuning.noise_evidence) likeliest.noise = SlowNoise();
  const bool changed = likeliest.noise != slow_;
  slow_ = likeliest.noise;
  return changed;
}

bool Loop::UpdateJointNoise(const JointRows& joint) {
  const double before = joint_noise_;
  const LikeliestJointNoise likeliest = JointNoiseInsteadOfMembers(joint);
  joint_noise_ = likeliest.sigma;
  if (joint_noise_ > 0 && !in_.sigma_known) {
    noise_.sigma *= std::sqrt(likeliest.rest);
    noise_.sigma_rotation *= std::sqrt(likeliest.rest);
  }
  return std::abs(joint_noise_ - before) > kJointNoiseSettled * std::max(joint_noise_, before);
}

LikeliestJointNoise Loop::JointNoiseInsteadOfMembers(const JointRows& joint) const {
  // One shape of noise at a time: the filter of slow noise has turned the rows already.
  if (!slow_.none()) return {};
  RowChoice plain = Choice();
  plain.weights.joint_noise = 0;
  const auto left_by = [&](const JointState& state) {
    return DesignRows(model_.calibration(), state.deltas, plain.weights, plain.readings);
  };
  JointState bare = joint.state;
  const double unknowns = TakeOut([](const Item&) { return true; }, &bare);
  const DesignRows rows = left_by(FitJointly(model_, bare, plain, joint.free, 1).state);
  const double worth = unknowns > 0 ? WorthOf(unknowns, rows, left_by(joint.state)) : 0;
  const LikeliestJointNoise likeliest =
      FindJointNoise(rows.y(), ByAngles(model_.calibration(), rows), rows.coordinates());
  return likeliest.evidence < std::max(kTuning.noise_evidence, worth) ? LikeliestJointNoise()
                                                                      : likeliest;
}

bool Loop::UpdateRows(JointRows* joint) {
  const std::set<int> off_before = off_;
  const double sigma_before = noise_.sigma;
  UpdateOutliers(*joint, true);
  bool changed = DoubtRounding(*joint);
  if (changed) *joint = FitJointly(model_, joint->state, Choice(), joint->free, 1);
  DoubtNoise(*joint);
  UpdateNoise(*joint);
  if (UpdateSlowNoise(*joint)) changed = true;
  if (UpdateJointNoise(*joint)) changed = true;
  return changed || off_ != off_before ||
         std::abs(std::log(noise_.sigma / sigma_before)) > kNoiseSettled;
}

void Loop::RobustStart() {
  JointState state = model_.Start();
  const std::vector<int> all = model_.AllUnknowns();
  JointRows joint = FitJointly(model_, state, Choice(), all, kFarSteps);
  // Weights by the residuals, then one more step with them.
  const auto reweigh = [&] {
    const int m = joint.rows->coordinates();
    VectorXd weight = VectorXd::Ones(model_.calibration().recording.num_rows());
    VectorXd y = joint.y();
    for (int k = 0; k < joint.rows->num_readings(); ++k) {
      const int row = joint.rows->recording_row(k);
      if (weight_.size() > 0) y.segment(k * m, m) /= std::sqrt(std::max(weight_[row], 1e-12));
    }
    const double variance = std::max(RobustVariance(y, m), 1e-300);
    for (int k = 0; k < joint.rows->num_readings(); ++k) {
      const double u = std::sqrt(y.segment(k * m, m).squaredNorm() / (variance * m));
      const int row = joint.rows->recording_row(k);
      weight[row] = u < kHuber ? 1.0 : kHuber * kHuber / (u * u);
    }
    weight_ = weight;
    joint = FitJointly(model_, joint.state, Choice(), all, 1);
  };
  for (int block = 0; block <= kTuning.start_blocks; ++block) {
    reweigh();
    reweigh();
    if (block == kTuning.start_blocks) break;
    const Bank bank(model_, joint, Items(joint, true), all);
    const VectorXd gains = bank.Gains(bank.members());
    const EvidenceRule rule = RuleAt(joint, all.size(), 1);
    const double rss = joint.y().squaredNorm();
    int best = -1;
    double best_p = std::log(kTuning.start_p);
    for (Index i = 0; i < gains.size(); ++i) {
      const Item& item = bank.items()[static_cast<std::size_t>(i)];
      const double p = LogChanceOfGain(gains[i], item.size, rss, rule);
      if (p < best_p) {
        best_p = p;
        best = static_cast<int>(i);
      }
    }
    if (best < 0) break;
    Member member;
    member.item = bank.items()[static_cast<std::size_t>(best)];
    member.value = VectorXd::Zero(member.item.size);
    const double columns = static_cast<double>(joint.X.cols() + member.item.size);
    if (columns > kColumnsOfRows * static_cast<double>(joint.y().size())) break;
    JointState larger = joint.state;
    larger.members.push_back(std::move(member));
    joint = FitJointly(model_, larger, Choice(), all, 1);
  }
  const double scale = RobustVariance(joint.y(), joint.rows->coordinates());
  weight_.resize(0);
  if (!in_.sigma_known) {
    noise_.sigma *= std::sqrt(std::max(scale, 1e-12));
    noise_.sigma_rotation *= std::sqrt(std::max(scale, 1e-12));
  }
  UpdateOutliers(joint, false);
}

}  // namespace dhcal
