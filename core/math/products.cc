#include "core/math/products.h"

#include <algorithm>
#include <limits>

#include <glog/logging.h>

#include "core/base/parallel.h"
#include "core/simd/aligned.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Ref;

// Rows and columns of A that are worked on together: a few columns stay in the first cache, all in
// the second.
constexpr Index kPanelRows = 512;
constexpr Index kPanelCols = 96;
// The same for A C, which goes along the rows: all of it stays in the first cache.
constexpr Index kShortRows = 32;
// Columns of the right factor that one thread takes at a time; products smaller than the second
// are not worth a thread.
constexpr Index kColsPerPiece = 192;
constexpr double kWorthAThread = 1e7;  // multiplications

/// Rows of a matrix, copied to memory as the kernels like it best: columns at whole vectors, pages
/// close to each other, zeros below up to a whole pack.
class Panel {
 public:
  Panel(Index rows, Index cols) : stride_(WholePacks(rows)) {
    memory_.resize(static_cast<std::size_t>(stride_ * cols));
  }

  void Take(const Ref<const MatrixXd>& rows) {
    num_rows_ = WholePacks(rows.rows());
    num_cols_ = rows.cols();
    for (Index k = 0; k < num_cols_; ++k) {
      double* const to = memory_.data() + k * stride_;
      std::copy_n(rows.data() + k * rows.outerStride(), rows.rows(), to);
      std::fill(to + rows.rows(), to + num_rows_, 0.0);
    }
  }

  const double* data() const { return memory_.data(); }
  double* data() { return memory_.data(); }
  int num_rows() const { return static_cast<int>(num_rows_); }
  int num_cols() const { return static_cast<int>(num_cols_); }
  std::ptrdiff_t stride() const { return stride_; }

 private:
  static Index WholePacks(Index rows) {
    return (rows + simd::kLanes - 1) / simd::kLanes * simd::kLanes;
  }

  simd::AlignedDoubles memory_;
  Index stride_ = 0, num_rows_ = 0, num_cols_ = 0;
};

/// work(first, count) for pieces of the columns 0 ... cols - 1.
template <typename Work>
void ForPieces(Index cols, double multiplications, const Work& work) {
  const Index pieces = (cols + kColsPerPiece - 1) / kColsPerPiece;
  ParallelFor(
      static_cast<int>(pieces),
      [&](int piece) {
        const Index first = piece * kColsPerPiece;
        work(first, std::min(kColsPerPiece, cols - first));
      },
      multiplications < kWorthAThread ? 1 : NumProcessors());
}

/// Columns of A'B; of A'A only what is not above the diagonal.
MatrixXd CrossOfPiece(const simd::Kernels& kernels,
                      const Ref<const MatrixXd>& A,
                      const Ref<const MatrixXd>& B,
                      bool lower_only) {
  MatrixXd products = MatrixXd::Zero(A.cols(), B.cols());
  const Index most = std::min(kPanelRows, A.rows());
  Panel left(most, std::min(kPanelCols, A.cols())), right(most, B.cols());
  for (Index row = 0; row < A.rows(); row += kPanelRows) {
    const Index count = std::min(kPanelRows, A.rows() - row);
    right.Take(B.middleRows(row, count));
    for (Index col = 0; col < A.cols(); col += kPanelCols) {
      left.Take(A.block(row, col, count, std::min(kPanelCols, A.cols() - col)));
      simd::CrossArgs args;
      args.num_rows = left.num_rows();
      args.cols_A = left.num_cols();
      args.cols_B = right.num_cols();
      args.A = left.data();
      args.stride_A = left.stride();
      args.B = right.data();
      args.stride_B = right.stride();
      args.products = &products(col, 0);
      args.stride_products = products.outerStride();
      args.lower_only = lower_only && col == 0;
      kernels.cross(args);
    }
  }
  return products;
}

void DeductFromPiece(const simd::Kernels& kernels,
                     const Ref<const MatrixXd>& A,
                     const Ref<const MatrixXd>& C,
                     Ref<MatrixXd> B) {
  Panel left(kShortRows, std::min(kPanelCols, A.cols()));
  Panel right(std::min(kPanelRows, A.rows()), B.cols());
  for (Index panel = 0; panel < A.rows(); panel += kPanelRows) {
    const Index rows = std::min(kPanelRows, A.rows() - panel);
    right.Take(B.middleRows(panel, rows));
    for (Index row = 0; row < rows; row += kShortRows) {
      const Index count = std::min(kShortRows, rows - row);
      for (Index col = 0; col < A.cols(); col += kPanelCols) {
        const Index width = std::min(kPanelCols, A.cols() - col);
        left.Take(A.block(panel + row, col, count, width));
        simd::DeductArgs args;
        args.num_rows = left.num_rows();
        args.cols_A = left.num_cols();
        args.cols_B = right.num_cols();
        args.A = left.data();
        args.stride_A = left.stride();
        args.C = C.data() + col;
        args.stride_C = C.outerStride();
        args.B = right.data() + row;
        args.stride_B = right.stride();
        kernels.deduct(args);
      }
    }
    for (Index k = 0; k < B.cols(); ++k) {
      std::copy_n(right.data() + k * right.stride(), rows, &B(panel, k));
    }
  }
}

double Multiplications(Index rows, Index cols, Index other_cols) {
  return static_cast<double>(rows) * static_cast<double>(cols) * static_cast<double>(other_cols);
}

/// A R^-1, R = chol(A'A); columns of A may depend on each other to rounding.
MatrixXd DividedByItsRoot(const MatrixXd& A, const simd::Kernels& kernels) {
  const Index n = A.cols();
  const Eigen::VectorXd scale =
      A.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const MatrixXd square = scale.asDiagonal() * SquareOf(A, kernels) * scale.asDiagonal();
  // What rounding leaves of a square, at first.
  double shift = 4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  Eigen::LLT<MatrixXd> root;
  do {
    MatrixXd shifted = square;
    shifted.diagonal().array() += shift;
    root.compute(shifted);
    shift *= 100;
  } while (root.info() != Eigen::Success && shift < 1);
  return TallProduct(A, scale.asDiagonal() * InverseRoot(root), kernels);
}

}  // namespace

MatrixXd TransposedProduct(const Ref<const MatrixXd>& A,
                           const Ref<const MatrixXd>& B,
                           const simd::Kernels& kernels) {
  CHECK_EQ(A.rows(), B.rows());
  MatrixXd products(A.cols(), B.cols());
  ForPieces(B.cols(), Multiplications(A.rows(), A.cols(), B.cols()), [&](Index first, Index count) {
    products.middleCols(first, count) = CrossOfPiece(kernels, A, B.middleCols(first, count), false);
  });
  return products;
}

MatrixXd SquareOf(const Ref<const MatrixXd>& A, const simd::Kernels& kernels) {
  const Index n = A.cols();
  MatrixXd square(n, n);
  ForPieces(n, Multiplications(A.rows(), n, n), [&](Index first, Index count) {
    square.block(first, first, n - first, count) =
        CrossOfPiece(kernels, A.rightCols(n - first), A.middleCols(first, count), true);
  });
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
  return square;
}

MatrixXd Deducted(MatrixXd B,
                  const Ref<const MatrixXd>& A,
                  const Ref<const MatrixXd>& C,
                  const simd::Kernels& kernels) {
  CHECK_EQ(A.rows(), B.rows());
  CHECK_EQ(A.cols(), C.rows());
  CHECK_EQ(B.cols(), C.cols());
  ForPieces(B.cols(), Multiplications(A.rows(), A.cols(), B.cols()), [&](Index first, Index count) {
    DeductFromPiece(kernels, A, C.middleCols(first, count), B.middleCols(first, count));
  });
  return B;
}

MatrixXd TallProduct(const Ref<const MatrixXd>& A,
                     const Ref<const MatrixXd>& C,
                     const simd::Kernels& kernels) {
  return Deducted(MatrixXd::Zero(A.rows(), C.cols()), A, -C, kernels);
}

MatrixXd InverseRoot(const Eigen::LLT<MatrixXd>& factor) {
  return factor.matrixU().solve(MatrixXd::Identity(factor.rows(), factor.rows()));
}

MatrixXd DividedByRoot(const Eigen::LLT<MatrixXd>& factor,
                       const Ref<const MatrixXd>& B,
                       const simd::Kernels& kernels) {
  return TransposedProduct(InverseRoot(factor), B, kernels);
}

MatrixXd OrthonormalColumns(MatrixXd A, const simd::Kernels& kernels) {
  if (A.cols() == 0) return A;
  constexpr int kPasses = 3;
  for (int pass = 0; pass < kPasses; ++pass) A = DividedByItsRoot(A, kernels);
  return A;
}

}  // namespace dhcal
