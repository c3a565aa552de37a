// Geometry, effects and masses in one fit, on recordings whose truth is known.
#include "problems/diagnosis/refit/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "problems/diagnosis/hypotheses/library.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using Eigen::VectorXd;

Draw DrawOf(const std::vector<EffectRequest>& truth, std::uint64_t seed) {
  Scenario scenario;
  scenario.truth = truth;
  scenario.poses = 150;
  return MakeDraw(scenario, seed);
}

RowChoice AllRows(const JointModel& model) {
  RowChoice choice;
  choice.readings = model.calibration().readings.fitted;
  choice.weights.noise.sigma = model.spec().measurement.sigma.value();
  return choice;
}

JointState StartWith(const JointModel& model, const std::vector<EffectRequest>& effects) {
  JointState state = model.Start();
  const PhysicsContext context = model.calibration().Context();
  for (const EffectRequest& request : effects) {
    Member member;
    member.item = NamedItem(context, request, 1);
    member.value = VectorXd::Zero(member.item.size);
    state.members.push_back(member);
  }
  return state;
}

TEST(JointFit, RecoversTwoCompliancesAtOnce) {
  const std::vector<EffectRequest> truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}}),
                                            Request("joint_compliance", 3, {{"compliance", 5e-6}})};
  const Draw draw = DrawOf(truth, 1);
  const JointModel model(draw.spec, draw.recording);
  const RowChoice choice = AllRows(model);
  const JointRows fit = FitJointly(model, StartWith(model, truth), choice, model.AllUnknowns(), 8);
  const VectorXd values = TiedValues(model, fit);
  EXPECT_NEAR(values[0], 3e-6, 1e-7);
  EXPECT_NEAR(values[1], 5e-6, 2e-7);
  EXPECT_LT(fit.phi, 1.3) << "down to the noise";
}

TEST(JointFit, DerivativesAreThoseOfTheResidual) {
  const std::vector<EffectRequest> truth = {
      Request("joint_compliance", 2, {{"compliance", 3e-6}}),
      Request("gear_harmonic", 3, {{"sin_2", 1e-4}}, {{"order", 2}})};
  const Draw draw = DrawOf(truth, 2);
  const JointModel model(draw.spec, draw.recording);
  const RowChoice choice = AllRows(model);
  const JointRows at = FitJointly(model, StartWith(model, truth), choice, model.AllUnknowns(), 4);
  for (std::size_t m = 0; m < truth.size(); ++m) {
    JointState moved = at.state;
    const double step = 0.05 * moved.members[m].item.typical[0];
    moved.members[m].value[0] += step;
    const JointRows there = model.At(moved, choice, at.free);
    const VectorXd change = (at.y() - there.y()) / step;
    const VectorXd column = at.X.col(at.FirstColumn(m));
    EXPECT_LT((change - column).norm(), 0.01 * column.norm()) << m;
  }
}

TEST(JointFit, ErrorsOfTheMassesAreLearnt) {
  const Draw draw = DrawOf({Request("joint_compliance", 2, {{"compliance", 5e-6}})}, 3);
  ProblemSpec wrong = draw.spec;
  for (LinkMass& link : wrong.robot.links) link.mass *= 1.2;
  wrong.robot.links[2].p_LC.z() += 0.04;
  const JointModel model(wrong, draw.recording);
  const JointRows fit = FitJointly(model,
                                   StartWith(model, {Request("joint_compliance", 2)}),
                                   AllRows(model),
                                   model.AllUnknowns(),
                                   6);
  EXPECT_GT(fit.N.cols(), 0);
  EXPECT_LT(fit.phi, 1.3);
  EXPECT_NEAR(fit.state.members[0].value[0], 5e-6, 1.5e-6) << "masses and compliance share a scale";
}

TEST(JointFit, TiedMassesLeaveTheEffectItself) {
  const Draw draw = DrawOf({Request("joint_compliance", 2, {{"compliance", 1e-5}})}, 4);
  const JointModel model(draw.spec, draw.recording);
  const JointRows fit = FitJointly(model,
                                   StartWith(model, {Request("joint_compliance", 2)}),
                                   AllRows(model),
                                   model.AllUnknowns(),
                                   4);
  const Eigen::MatrixXd tied = TiedMasses(model, fit);
  const double sigma = std::sqrt(JointCovariance(model, fit)(
      static_cast<Eigen::Index>(fit.free.size()), static_cast<Eigen::Index>(fit.free.size())));
  EXPECT_EQ(tied.cols(), fit.N.cols());
  EXPECT_LT(sigma, 0.05e-5) << "as sure as with masses that are exact";
  EXPECT_NEAR(fit.state.members[0].value[0], 1e-5, 0.3e-5);
}

TEST(JointFit, ARobotWithoutMassesGetsOneComplianceEach) {
  Draw draw = DrawOf({Request("joint_compliance", 2, {{"compliance", 1e-5}})}, 5);
  draw.spec.robot.links.clear();
  const JointModel model(draw.spec, draw.recording);
  EXPECT_FALSE(model.masses_given());
  const JointState start = StartWith(model, {Request("joint_compliance", 2)});
  EXPECT_EQ(start.members[0].item.size, 1);
  const JointRows fit = FitJointly(model, start, AllRows(model), model.AllUnknowns(), 8);
  EXPECT_LT(fit.phi, 2) << "the loads come near the true ones";
}

}  // namespace
}  // namespace dhcal
