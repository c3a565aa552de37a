// Readings that lie off at one place of a joint are told from misreadings.
#include "problems/diagnosis/rows/moved_by_joint.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/random_matrix.h"

namespace dhcal {
namespace {

constexpr int kReadings = 200;

struct Drawn {
  std::vector<JointAtReadings> joints;
  Eigen::VectorXd residuals;
  std::vector<bool> off;
};

/// Six joints anywhere; every `every`-th reading lies off, in any direction.
Drawn Misread(std::uint64_t seed, int every) {
  Rng rng(seed);
  Drawn drawn;
  for (int joint = 0; joint < 6; ++joint) {
    drawn.joints.push_back(
        {RandomMatrix(kReadings, 1, &rng), RandomMatrix(3 * kReadings, 1, &rng)});
  }
  drawn.residuals = RandomMatrix(3 * kReadings, 1, &rng);
  for (int k = 0; k < kReadings; ++k) {
    drawn.off.push_back(k % every == 0);
    if (drawn.off.back()) drawn.residuals.segment<3>(3 * k) *= 10;
  }
  return drawn;
}

std::ptrdiff_t Count(const std::vector<bool>& which) {
  return std::count(which.begin(), which.end(), true);
}

std::ptrdiff_t Count(const std::vector<int>& joints) {
  return std::count_if(joints.begin(), joints.end(), [](int joint) { return joint >= 0; });
}

TEST(MovedByAJoint, NoneOfMisreadingsAnywhere) {
  int recordings = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Drawn drawn = Misread(seed, 10);
    if (Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)) > 0) ++recordings;
  }
  EXPECT_LE(recordings, 3) << "0.3 are expected";
}

TEST(MovedByAJoint, ThoseAtADamagedTooth) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Drawn drawn = Misread(seed, 20);
    std::vector<bool> tooth(kReadings, false);
    for (int k = 0; k < kReadings; ++k) {
      const auto at = static_cast<std::size_t>(k);
      tooth[at] = std::abs(drawn.joints[2].place[k] - 0.5) < 0.1;
      if (!tooth[at]) continue;
      drawn.off[at] = true;
      drawn.residuals.segment<3>(3 * k) = -8 * drawn.joints[2].motion.segment<3>(3 * k);
    }
    const std::vector<int> moved = MovedByAJoint(drawn.joints, drawn.residuals, drawn.off);
    ASSERT_GE(Count(tooth), 6) << seed;
    for (std::size_t k = 0; k < tooth.size(); ++k) {
      if (tooth[k]) {
        EXPECT_EQ(moved[k], 2) << seed << " " << k;
      }
    }
    EXPECT_LE(Count(moved), Count(tooth) + 2) << seed;
  }
}

TEST(MovedByAJoint, FewIfNoneIsElsewhere) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Drawn drawn = Misread(seed, kReadings + 1);
    drawn.off[0] = false;
    int marked = 0, last = -10;
    for (int k = 0; k < kReadings && marked < 4; ++k) {
      if (std::abs(drawn.joints[4].place[k] - 0.2) > 0.15 || k < last + 4) continue;
      last = k;
      drawn.off[static_cast<std::size_t>(k)] = true;
      drawn.residuals.segment<3>(3 * k) = 9 * drawn.joints[4].motion.segment<3>(3 * k);
      ++marked;
    }
    EXPECT_EQ(Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)), 4) << seed;
    // One more that is elsewhere, and it could be chance.
    const auto far = static_cast<std::size_t>(
        std::max_element(drawn.joints[4].place.begin(), drawn.joints[4].place.end()) -
        drawn.joints[4].place.begin());
    drawn.off[far] = true;
    EXPECT_EQ(Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)), 0) << seed;
  }
}

TEST(MovedByAJoint, NoneOfAFewMisreadDistances) {
  int recordings = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Drawn drawn = Misread(seed, 20);  // ten
    drawn.residuals.conservativeResize(kReadings);
    for (JointAtReadings& joint : drawn.joints) joint.motion.conservativeResize(kReadings);
    if (Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)) > 0) ++recordings;
  }
  EXPECT_LE(recordings, 5) << "1 is expected at most";
}

TEST(MovedByAJoint, NoneOfAFewMisreadings) {
  int recordings = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const Drawn drawn = Misread(seed, 60);  // four
    if (Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)) > 0) ++recordings;
  }
  EXPECT_LE(recordings, 9) << "3 are expected at most";
}

TEST(MovedByAJoint, NeedsReadings) {
  EXPECT_TRUE(MovedByAJoint({}, {}, {}).empty());
  const Drawn drawn = Misread(1, 500);  // a single one
  EXPECT_EQ(Count(MovedByAJoint(drawn.joints, drawn.residuals, drawn.off)), 0);
}

}  // namespace
}  // namespace dhcal
