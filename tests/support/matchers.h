// A matcher for matrices and vectors that says where and how far they differ.
//   EXPECT_THAT(actual, MatrixNear(expected, 1e-12));
#ifndef DHCAL_TESTS_SUPPORT_MATCHERS_H_
#define DHCAL_TESTS_SUPPORT_MATCHERS_H_

#include <cmath>
#include <ostream>
#include <utility>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dhcal {

/// Every entry within `tolerance` of the expected one, and the same shape. NaN is near nothing, so
/// that an output that was never written fails.
class MatrixNearMatcher {
 public:
  MatrixNearMatcher(Eigen::MatrixXd expected, double tolerance)
      : expected_(std::move(expected)), tolerance_(tolerance) {}

  template <typename Derived>
  bool MatchAndExplain(const Eigen::MatrixBase<Derived>& matrix,
                       testing::MatchResultListener* listener) const {
    const Eigen::MatrixXd actual = matrix;
    if (actual.rows() != expected_.rows() || actual.cols() != expected_.cols()) {
      *listener << "which is " << actual.rows() << " x " << actual.cols() << ", not "
                << expected_.rows() << " x " << expected_.cols();
      return false;
    }
    Eigen::Index row = 0, col = 0;
    const double worst = Worst(actual, &row, &col);
    if (worst <= tolerance_) return true;
    *listener << "which is\n"
              << Print(actual) << "\nand differs most at (" << row << ", " << col
              << "): " << testing::PrintToString(actual(row, col)) << " instead of "
              << testing::PrintToString(expected_(row, col)) << ", |difference| = " << worst
              << " > tolerance " << tolerance_;
    return false;
  }

  void DescribeTo(std::ostream* os) const {
    *os << "is within " << tolerance_ << " of\n" << Print(expected_);
  }
  void DescribeNegationTo(std::ostream* os) const {
    *os << "is not within " << tolerance_ << " of\n" << Print(expected_);
  }

 private:
  static Eigen::WithFormat<Eigen::MatrixXd> Print(const Eigen::MatrixXd& matrix) {
    static const Eigen::IOFormat format(Eigen::FullPrecision);
    return matrix.format(format);
  }

  /// Largest difference and where it is; infinite where a number is NaN.
  double Worst(const Eigen::MatrixXd& actual, Eigen::Index* row, Eigen::Index* col) const {
    if (actual.size() == 0) return 0;
    Eigen::ArrayXXd difference = (actual - expected_).array().abs();
    difference = difference.isNaN().select(HUGE_VAL, difference);
    return difference.maxCoeff(row, col);
  }

  Eigen::MatrixXd expected_;
  double tolerance_;
};

template <typename Derived>
testing::PolymorphicMatcher<MatrixNearMatcher> MatrixNear(
    const Eigen::MatrixBase<Derived>& expected, double tolerance) {
  return testing::MakePolymorphicMatcher(MatrixNearMatcher(expected, tolerance));
}

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_MATCHERS_H_
