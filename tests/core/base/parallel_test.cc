// Every piece is done once, and all are done at the return.
#include "core/base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(ParallelFor, DoesEachPieceOnce) {
  for (const int count : {1, 2, 7, 1000}) {
    std::vector<int> times(static_cast<std::size_t>(count), 0);
    ParallelFor(count, [&](int k) { ++times[static_cast<std::size_t>(k)]; });
    EXPECT_EQ(times, std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST(ParallelFor, DoesNothingWhereThereIsNothingToDo) {
  ParallelFor(0, [](int /*k*/) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace dhcal
