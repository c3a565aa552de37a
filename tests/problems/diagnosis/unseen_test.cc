// Squares of predictions from normal equations are those of the predictions themselves.
#include "problems/diagnosis/unseen.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

class LeftOutRowsTest : public testing::Test {
 protected:
  LeftOutRowsTest() {
    Scenario scenario;
    scenario.truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}})};
    draw_ = MakeDraw(scenario, 11);
    fit_ = FitComplete(draw_.spec,
                       draw_.recording,
                       {Request("joint_compliance", 2),
                        Request("joint_gain", 3),
                        Request("transmission_error", 4)},
                       {});
  }
  Draw draw_;
  std::unique_ptr<CompleteFit> fit_;
};

TEST_F(LeftOutRowsTest, SquaresAreThoseOfTheResidualsWhateverIsDropped) {
  ASSERT_TRUE(fit_->usable());
  const LeftOutRows rows(*fit_, MakeFolds(fit_->calibration));
  std::vector<int> curve(fit_->calibration.effect_columns.size() - 2);
  std::iota(curve.begin(), curve.end(), 2);
  for (const std::vector<int>& dropped : {{}, {0}, {1}, {0, 1}, curve}) {
    const double squares = rows.Residuals(dropped).squaredNorm();
    EXPECT_NEAR(rows.Squares(dropped), squares, 1e-8 * squares) << dropped.size();
  }
}

TEST_F(LeftOutRowsTest, MissWhatIsDroppedWhereItIsThere) {
  ASSERT_TRUE(fit_->usable());
  const LeftOutRows rows(*fit_, MakeFolds(fit_->calibration));
  const double all = rows.Squares({});
  EXPECT_GT(rows.Squares({0}), 1.5 * all);         // the compliance is there
  EXPECT_LT(rows.Squares({1}), all + 0.05 * all);  // the gain is not
  EXPECT_LT(rows.Fitted({}).squaredNorm(), all);   // fitted is never worse
  EXPECT_GT(rows.Fitted({0}).squaredNorm(), rows.Fitted({}).squaredNorm());
}

}  // namespace
}  // namespace dhcal
