// Which body bends, and under what: the same whichever way the rows are written.
#include <string>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/physics/registry.h"
#include "tests/support/robots.h"

namespace dhcal {
namespace {

/// One arm, its links and their masses in standard and in modified rows.
class LinkBendingOfBothConventions : public testing::Test {
 protected:
  LinkBendingOfBothConventions() {
    Rng rng(11);
    rows_.q.resize(8, standard_.num_joints());
    for (double& q : rows_.q.reshaped()) q = rng.Uniform(-2, 2);
    rows_.payload = Eigen::VectorXd::LinSpaced(8, 0, 14);
    standard_.payload.p_LC = modified_.payload.p_LC = Eigen::Vector3d(0.05, 0, 0.12);
    // A body is the same body; only the frame differs that its centre of mass is given in.
    const Eigen::VectorXd q = rows_.q.row(0);
    const auto standard_frames = DhChain(standard_).LinkFrames(q);
    const auto modified_frames = DhChain(modified_).LinkFrames(q);
    for (std::size_t k = 0; k < standard_.joints.size(); ++k) {
      LinkMass link;
      link.mass = rng.Uniform(5, 50);
      link.p_LC = Eigen::Vector3d(rng.Uniform(-0.2, 0.2), rng.Uniform(-0.2, 0.2), 0.1);
      standard_.links.push_back(link);
      link.p_LC = modified_frames[k + 1].inverse() * (standard_frames[k + 1] * link.p_LC);
      modified_.links.push_back(link);
    }
  }

  static EffectRequest Request(int link) {
    EffectRequest request;
    request.effect = "link_bending";
    request.joint = link;
    return request;
  }

  const Effect& effect_ = *FindEffect("link_bending");
  RobotModel standard_ = Kr15(), modified_ = Kr15Modified();
  Recording rows_;
};

TEST_F(LinkBendingOfBothConventions, MovesTheToolAlike) {
  const PhysicsContext standard(standard_, rows_, {standard_.X_WB});
  const PhysicsContext modified(modified_, rows_, {modified_.X_WB});
  int compared = 0;
  for (int link = 1; link <= standard_.num_joints(); ++link) {
    const EffectRequest request = Request(link);
    const std::string reason = effect_.NotTestable(standard, request);
    EXPECT_EQ(effect_.NotTestable(modified, request), reason) << "link " << link;
    if (!reason.empty()) continue;
    ++compared;
    const auto expected = effect_.Columns(standard, request);
    const auto columns = effect_.Columns(modified, request);
    ASSERT_EQ(columns.size(), expected.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ASSERT_EQ(columns[k].slots.size(), expected[k].slots.size());
      for (std::size_t i = 0; i < columns[k].slots.size(); ++i) {
        const Eigen::VectorXd& weight = expected[k].slots[i].weight;
        EXPECT_EQ(columns[k].slots[i].slot, expected[k].slots[i].slot);
        EXPECT_LT((columns[k].slots[i].weight - weight).norm(), 1e-9 * (1 + weight.norm()))
            << "link " << link;
      }
    }
  }
  EXPECT_GE(compared, 2) << "the upper arm and the forearm";
}

TEST_F(LinkBendingOfBothConventions, HasTheSameNameAndClass) {
  const PhysicsContext standard(standard_, rows_, {standard_.X_WB});
  const PhysicsContext modified(modified_, rows_, {modified_.X_WB});
  for (int link = 1; link <= standard_.num_joints(); ++link) {
    const EffectPlace expected = effect_.Place(standard, Request(link));
    const EffectPlace place = effect_.Place(modified, Request(link));
    EXPECT_EQ(place.location, expected.location);
    EXPECT_TRUE(place.effect_class == expected.effect_class) << "link " << link;
  }
  EXPECT_EQ(effect_.Place(modified, Request(2)).effect_class, EffectClass::kShoulderLoad);
  EXPECT_EQ(effect_.Candidates(modified).size(), effect_.Candidates(standard).size());
}

TEST_F(LinkBendingOfBothConventions, TheUpperArmCarriesNothingOfItself) {
  const PhysicsContext before(modified_, rows_, {modified_.X_WB});
  RobotModel heavier = modified_;
  heavier.links[1].mass += 100;
  const PhysicsContext after(heavier, rows_, {heavier.X_WB});
  const auto weight = [&](const PhysicsContext& context) {
    return effect_.Columns(context, Request(2))[0].slots[0].weight;
  };
  EXPECT_EQ(weight(before), weight(after));
  heavier.links[2].mass += 100;
  const PhysicsContext elbow(heavier, rows_, {heavier.X_WB});
  EXPECT_GT((weight(elbow) - weight(before)).norm(), 0.01 * weight(before).norm());
}

}  // namespace
}  // namespace dhcal
