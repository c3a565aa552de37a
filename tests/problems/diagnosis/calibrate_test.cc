// A whole run on recordings whose answer is known: what is delivered, and what is set aside.
#include "problems/diagnosis/calibrate.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/problem_cases.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(Calibrate, DeliversGeometryAndComplianceFittedTogether) {
  Scenario scenario;
  scenario.truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
  const Draw draw = MakeDraw(scenario, 1);
  const Result result = Calibrate(draw.spec, draw.recording, {});
  ASSERT_NE(result.best(), nullptr);
  ASSERT_TRUE(result.diagnosis.has_value());
  const DiagnosisResult& d = *result.diagnosis;
  ASSERT_EQ(d.verdict, DiagnosisVerdict::kExplained) << d.summary;
  ASSERT_TRUE(result.delivered.has_value());
  const DeliveredModel& model = *result.delivered;

  // The effect, held at about what was put in.
  ASSERT_THAT(model.effects, SizeIs(1));
  EXPECT_TRUE(model.effects[0].SameAs(scenario.truth[0]));
  EXPECT_TRUE(model.effects[0].held);
  ASSERT_EQ(model.effects[0].values.count("compliance"), 1u);
  EXPECT_NEAR(model.effects[0].values.at("compliance"), 3e-6, 0.1e-6);

  // As good as announced, and better than the geometry of the file.
  EXPECT_TRUE(model.fit.usable);
  EXPECT_NEAR(model.fit.rms, d.rms_train_after, 0.1 * d.rms_train_after);
  EXPECT_LT(model.fit.rms, 0.5 * result.best()->rms);
  EXPECT_LT(model.validation.rms_test, 0.5 * result.validation.rms_test);
  EXPECT_EQ(model.intervals, IntervalVerdict::kHold);
  EXPECT_EQ(result.delivered_fit(), &model.fit);

  // For controllers that take DH rows only: the fit of the file.
  ASSERT_TRUE(model.rigid.has_value());
  for (std::size_t i = 0; i < model.rigid->joints.size(); ++i) {
    EXPECT_EQ(model.rigid->joints[i].theta, result.calibrated.joints[i].theta);
  }

  // Every row has the third prediction, and what is left is of that one.
  ASSERT_EQ(static_cast<int>(result.residuals.size()), draw.recording.num_rows());
  for (const RowResidual& row : result.residuals) {
    ASSERT_EQ(row.predicted_effects.size(), 3) << row.row_idx;
    EXPECT_NEAR((row.measured - row.predicted_effects - row.residual).norm(), 0, 1e-12);
    EXPECT_NEAR(row.residual.norm(), row.length, 1e-12);
  }
}

/// Slope of y over x through zero.
double Slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y) { return x.dot(y) / x.dot(x); }

TEST(Calibrate, DeliversHowItsJointsErr) {
  // Put in: compliance in joint 2, 0.3 mrad of backlash in joint 4, in joint 3 0.07 mrad at 121
  // cycles per turn.
  const ProblemSpec spec = LoadCase("kr15_left_out");
  const Result result = Calibrate(spec, RecordingOf(spec), {});
  ASSERT_TRUE(result.delivered.has_value());
  const std::vector<JointErrors>& all = result.delivered->joint_errors;
  ASSERT_THAT(all, SizeIs(3));
  for (std::size_t k = 0; k < all.size(); ++k) {
    SCOPED_TRACE(k);
    const auto count = static_cast<Eigen::Index>(all[k].q.size());
    const Eigen::VectorXd error = Eigen::Map<const Eigen::VectorXd>(all[k].error.data(), count);
    const Eigen::VectorXd model = Eigen::Map<const Eigen::VectorXd>(all[k].modelled.data(), count);
    EXPECT_EQ(all[k].joint_idx, static_cast<int>(k) + 1);
    EXPECT_GT(count, 50);
    EXPECT_NEAR(Slope(model, error), 1, 0.1);  // the readings say what the model says
    if (k == 1) {
      EXPECT_NEAR(std::sqrt(2 * model.squaredNorm() / static_cast<double>(count)), 7e-5, 1e-5);
    }
    if (k == 2) {
      EXPECT_NEAR(model.maxCoeff(), 1.5e-4, 2e-5);
      EXPECT_NEAR(model.minCoeff(), -1.5e-4, 2e-5);
    }
  }
}

TEST(Calibrate, ACleanRecordingHasNoDeliveredModel) {
  const Draw draw = MakeDraw(Scenario(), 1);
  const Result result = Calibrate(draw.spec, draw.recording, {});
  ASSERT_TRUE(result.diagnosis.has_value());
  EXPECT_EQ(result.diagnosis->verdict, DiagnosisVerdict::kConsistent) << result.diagnosis->summary;
  EXPECT_FALSE(result.delivered.has_value());
  EXPECT_EQ(result.delivered_fit(), result.best());
  for (const RowResidual& row : result.residuals) EXPECT_EQ(row.predicted_effects.size(), 0);
}

TEST(Calibrate, AMisreadRowIsSetAsideAndNotFitted) {
  constexpr int kMisread = 37;
  Draw draw = MakeDraw(Scenario(), 1);
  draw.recording.p_WQ(kMisread, 1) += 10e-3;
  const Result result = Calibrate(draw.spec, draw.recording, {});
  ASSERT_TRUE(result.diagnosis.has_value());
  ASSERT_THAT(result.rows_set_aside, SizeIs(1));
  const RowSetAside& aside = result.rows_set_aside[0];
  EXPECT_EQ(aside.row_idx, kMisread);
  EXPECT_FALSE(aside.test);
  EXPECT_NEAR(aside.size, 10e-3, 0.5e-3);
  EXPECT_THAT(aside.reason, Not(IsEmpty()));

  EXPECT_EQ(result.rows, draw.recording.num_rows() - 1);
  ASSERT_NE(result.best(), nullptr);
  EXPECT_LT(result.best()->rms, 1.3 * draw.spec.measurement.sigma.value());
  ASSERT_EQ(static_cast<int>(result.residuals.size()), draw.recording.num_rows());
  for (const RowResidual& row : result.residuals) {
    EXPECT_EQ(row.set_aside, row.row_idx == kMisread ? aside.reason : "") << row.row_idx;
  }
}

TEST(Calibrate, SpeaksOfRoundedAnglesOnlyWhereTheyLeaveAsMuch) {
  // The paper's increments are tenths of a degree, and exact: 39 nm are left.
  const ProblemSpec spec = LoadCase("kr15");
  const Recording exact = RecordingOf(spec);
  const auto speaks = testing::Contains(testing::HasSubstr("in steps of 0.1 deg"));
  EXPECT_THAT(Calibrate(spec, exact, {}).notes, Not(speaks));
  // Angles that were rounded to such steps after the arm had stood elsewhere leave far more.
  Scenario scenario;
  Draw draw = MakeDraw(scenario, 3);
  draw.recording.q = (draw.recording.q / (0.1 * kDegree)).array().round() * (0.1 * kDegree);
  EXPECT_THAT(Calibrate(draw.spec, draw.recording, {}).notes, speaks);
}

TEST(Calibrate, WithoutADiagnosisNothingIsDeliveredOrSetAside) {
  Draw draw = MakeDraw(Scenario(), 1);
  draw.spec.diagnosis.run = DiagnosisRun::kNever;
  draw.recording.p_WQ(37, 1) += 10e-3;
  const Result result = Calibrate(draw.spec, draw.recording, {});
  EXPECT_FALSE(result.diagnosis.has_value());
  EXPECT_FALSE(result.delivered.has_value());
  EXPECT_THAT(result.rows_set_aside, IsEmpty());
  EXPECT_EQ(result.rows, draw.recording.num_rows());
}

}  // namespace
}  // namespace dhcal
