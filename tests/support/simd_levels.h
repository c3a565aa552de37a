// What tests of the SIMD kernels share: every level that this processor runs, and equality of bits.
#ifndef DHCAL_TESTS_SUPPORT_SIMD_LEVELS_H_
#define DHCAL_TESTS_SUPPORT_SIMD_LEVELS_H_

#include <cstring>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/simd/level.h"

namespace dhcal {

/// True if both have the same shape and the same bits; tells 0 from -0, and NaN equals itself.
inline testing::AssertionResult SameBits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return testing::AssertionFailure() << "shapes differ";
  }
  for (Eigen::Index col = 0; col < a.cols(); ++col) {
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
      if (std::memcmp(&a(row, col), &b(row, col), sizeof(double)) == 0) continue;
      return testing::AssertionFailure()
             << "(" << row << ", " << col << "): " << testing::PrintToString(a(row, col))
             << " is not " << testing::PrintToString(b(row, col)) << ", difference "
             << a(row, col) - b(row, col);
    }
  }
  return testing::AssertionSuccess();
}

inline std::string LevelName(const testing::TestParamInfo<const simd::Kernels*>& level) {
  return level.param->name;
}

/// A test per level: INSTANTIATE_TEST_SUITE_P(Levels, <suite>, EveryLevel(), LevelName).
inline auto EveryLevel() { return testing::ValuesIn(simd::SupportedKernels()); }

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_SIMD_LEVELS_H_
