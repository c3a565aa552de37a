#include "core/simd/level.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace dhcal::simd {
namespace {

TEST(SimdLevel, TheBaselineIsAlwaysThereAndTheFastestComesLast) {
  ASSERT_FALSE(SupportedKernels().empty());
  EXPECT_STREQ(SupportedKernels().front()->name, "baseline");
  EXPECT_EQ(FindKernels("baseline"), SupportedKernels().front());
  for (const Kernels* kernels : SupportedKernels()) EXPECT_EQ(FindKernels(kernels->name), kernels);
  EXPECT_EQ(FindKernels("mmx"), nullptr);
}

TEST(SimdLevel, EachCompiledLevelBearsItsOwnName) {
  EXPECT_STREQ(kBaselineKernels->name, "baseline");
  const auto is = [](const Kernels* kernels, const std::string& name) {
    return kernels == nullptr || kernels->name == name;
  };
  EXPECT_TRUE(is(kAvx2Kernels, "avx2"));
  EXPECT_TRUE(is(kAvx512Kernels, "avx512"));
}

/// Runs in a process of its own: the level is chosen once.
[[noreturn]] void ExitWithWhetherActive(const char* wanted, const std::string& expected) {
  setenv("DHCAL_SIMD", wanted, 1);
  std::exit(ActiveKernels().name == expected ? 0 : 1);
}

TEST(SimdLevelDeathTest, TheEnvironmentChooses) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto succeeds = testing::ExitedWithCode(0);
  EXPECT_EXIT(ExitWithWhetherActive("baseline", "baseline"), succeeds, "");
  const std::string fastest = SupportedKernels().back()->name;
  EXPECT_EXIT(ExitWithWhetherActive("", fastest), succeeds, "");
  EXPECT_EXIT(ExitWithWhetherActive("mmx", fastest), succeeds, "DHCAL_SIMD=mmx is no SIMD level");
}

}  // namespace
}  // namespace dhcal::simd
