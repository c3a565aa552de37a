#include "core/math/tsqr.h"

#include <algorithm>

#include <Eigen/QR>
#include <glog/logging.h>

namespace dhcal {
namespace {

// Enough rows per factorisation that re-reducing the triangle costs little.
constexpr int kBlockRows = 512;

}  // namespace

Tsqr::Tsqr(int num_cols)
    : num_cols_(num_cols),
      buffer_(Eigen::MatrixXd::Zero(num_cols + std::max(kBlockRows, 2 * num_cols), num_cols)),
      r_(Eigen::MatrixXd::Zero(num_cols, num_cols)) {
  CHECK_GT(num_cols, 0);
}

void Tsqr::Add(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  CHECK_EQ(rows.cols(), num_cols_);
  num_rows_ += static_cast<int>(rows.rows());
  Eigen::Index done = 0;
  while (done < rows.rows()) {
    if (filled_ == buffer_.rows()) Reduce();
    const Eigen::Index count = std::min(buffer_.rows() - filled_, rows.rows() - done);
    buffer_.middleRows(filled_, count) = rows.middleRows(done, count);
    filled_ += static_cast<int>(count);
    done += count;
  }
}

void Tsqr::Reduce() {
  Eigen::Ref<Eigen::MatrixXd> rows = buffer_.topRows(filled_);
  // In place; the Householder vectors below the diagonal are dropped.
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(rows);
  filled_ = std::min(filled_, num_cols_);
  buffer_.topRows(filled_).triangularView<Eigen::StrictlyLower>().setZero();
}

const Eigen::MatrixXd& Tsqr::R() {
  if (filled_ > 0) Reduce();
  r_.setZero();
  r_.topRows(filled_) = buffer_.topRows(filled_);
  return r_;
}

}  // namespace dhcal
