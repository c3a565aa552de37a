#include "problems/diagnosis/judge/unseen_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "core/base/rng.h"
#include "core/math/products.h"
#include "problems/diagnosis/projection.h"
#include "problems/diagnosis/refit/joint_fit.h"
#include "problems/diagnosis/rows/outliers.h"
#include "problems/diagnosis/spectrum.h"
#include "problems/diagnosis/tuning.h"
#include "problems/diagnosis/unseen.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFoldsOfAWay = 5;
// A way that leaves so many times what another leaves asks for what its rows cannot know.
constexpr double kCannotKnow = 1.5;
constexpr std::uint64_t kRandomFolds = 11;

/// Blocks of consecutive rows.
std::vector<int> ConsecutiveFolds(int rows) {
  std::vector<int> folds;
  for (int row = 0; row < rows; ++row) folds.push_back(row * kFoldsOfAWay / std::max(rows, 1));
  return folds;
}

std::vector<int> RandomFolds(int rows) {
  Rng rng(kRandomFolds);
  std::vector<int> folds;
  for (int row = 0; row < rows; ++row) {
    folds.push_back(std::min(kFoldsOfAWay - 1, static_cast<int>(rng.Uniform(0, kFoldsOfAWay))));
  }
  return folds;
}

}  // namespace

UnseenRows::Rows UnseenRows::RowsOf(const JointRows& joint) const {
  Rows rows;
  const Index masses = static_cast<Index>(mass_idx_.size());
  rows.A = MatrixXd::Zero(joint.y().size(), num_free_ + joint.X.cols() + masses);
  rows.A.leftCols(num_free_) = joint.FreeColumns();
  rows.A.middleCols(num_free_, joint.X.cols()) = joint.X;
  for (Index k = 0; k < masses; ++k) {
    const auto found = std::find(
        joint.mass_idx.begin(), joint.mass_idx.end(), mass_idx_[static_cast<std::size_t>(k)]);
    if (found == joint.mass_idx.end()) continue;
    rows.A.col(num_free_ + joint.X.cols() + k) = joint.N.col(found - joint.mass_idx.begin());
  }
  rows.y = joint.y();
  Index first = 0;
  for (const Member& member : joint.state.members) {
    rows.y += joint.X.middleCols(first, member.item.size) * member.value;
    first += member.item.size;
  }
  return rows;
}

UnseenRows::UnseenRows(const JointModel& model,
                       const JointRows& joint,
                       const RowChoice& choice,
                       const std::vector<Reading>& test)
    : coordinates_(joint.rows->coordinates()),
      num_free_(static_cast<int>(joint.free.size())),
      mass_idx_(joint.mass_idx),
      mass_value_(joint.state.masses(joint.mass_idx)),
      row_of_(joint.rows->now_row()) {
  int first = num_free_;
  for (const Member& member : joint.state.members) {
    first_.push_back(first);
    size_.push_back(member.item.size);
    elastic_.push_back(member.item.elastic);
    scanned_.push_back(IsScannedLine(member.item.request));
    first += member.item.size;
  }
  white_ = RowsOf(joint);
  RowChoice as_read = choice;
  as_read.weights = RowWeights();
  as_read.weights.as_read = true;
  raw_ = RowsOf(model.At(joint.state, as_read, joint.free));
  const Augmented augmented = AugmentedRows(model, joint, joint.N);
  const Index rows = joint.y().size();
  const MatrixXd priors = augmented.B.bottomRows(augmented.B.rows() - rows);
  all_.H = SquareOf(white_.A) + priors.transpose() * priors;
  // The members are given back: the priors hold their values, not the steps from here.
  VectorXd held = augmented.y.tail(augmented.y.size() - rows);
  held += priors.middleCols(num_free_, joint.X.cols()) * joint.value;
  all_.b = white_.A.transpose() * white_.y + priors.transpose() * held;
  const Calibration& c = model.calibration();
  if (!test.empty()) {
    RowChoice of_test = choice;
    of_test.readings = test;
    test_white_ = RowsOf(model.At(joint.state, of_test, joint.free));
    of_test.weights = as_read.weights;
    test_raw_ = RowsOf(model.At(joint.state, of_test, joint.free));
    Way way;
    way.test = true;
    way.method = "set column";
    way.parts.push_back(all_);
    way.parts.back().predicted.resize(static_cast<std::size_t>(test_white_.y.size()));
    std::iota(way.parts.back().predicted.begin(), way.parts.back().predicted.end(), 0);
    ways_.push_back(std::move(way));
    return;
  }
  AddWay("blocks of rows left out in turn", ConsecutiveFolds(c.recording.num_rows()), kFoldsOfAWay);
  AddWay("rows left out at random", RandomFolds(c.recording.num_rows()), kFoldsOfAWay);
  const Folds regions = MakeFolds(c);
  AddWay("regions of poses left out in turn", regions.of_row, regions.count);
  ChooseAnnounced();
}

void UnseenRows::ChooseAnnounced() {
  std::vector<double> rms;
  rms.reserve(ways_.size());
  for (const Way& way : ways_) rms.push_back(RmsOfWay(way, {}));
  const double least = *std::min_element(rms.begin(), rms.end());
  while (announced_ + 1 < rms.size() && rms[announced_] > kCannotKnow * least) ++announced_;
}

void UnseenRows::AddWay(const std::string& method, const std::vector<int>& fold_of_row, int folds) {
  Way way;
  way.method = method;
  for (int fold = 0; fold < folds; ++fold) {
    Part part;
    for (std::size_t k = 0; k < row_of_.size(); ++k) {
      if (fold_of_row[static_cast<std::size_t>(row_of_[k])] == fold) {
        part.predicted.push_back(static_cast<int>(k));
      }
    }
    if (part.predicted.empty() || part.predicted.size() == row_of_.size()) continue;
    const MatrixXd A = white_.A(part.predicted, Eigen::all);
    const VectorXd y = white_.y(part.predicted);
    part.H = all_.H - SquareOf(A);
    part.b = all_.b - A.transpose() * y;
    way.parts.push_back(std::move(part));
  }
  ways_.push_back(std::move(way));
}

std::vector<int> UnseenRows::Kept(const std::vector<int>& dropped) const {
  std::vector<bool> out(static_cast<std::size_t>(all_.b.size()), false);
  for (const int m : dropped) {
    const auto at = static_cast<std::size_t>(m);
    // Without an elastic member its masses' columns would do its work.
    if (elastic_[at]) {
      const std::size_t masses = mass_idx_.size();
      std::fill(out.end() - static_cast<std::ptrdiff_t>(masses), out.end(), true);
    }
    for (int k = 0; k < size_[at]; ++k)
      out[static_cast<std::size_t>(first_[at]) + static_cast<std::size_t>(k)] = true;
  }
  std::vector<int> kept;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!out[k]) kept.push_back(static_cast<int>(k));
  }
  return kept;
}

VectorXd UnseenRows::Solve(const Part& part, const std::vector<int>& kept) const {
  constexpr double kSmall = 1e-11;  // of a scaled unknown's own squares
  const VectorXd scale = all_.H.diagonal()(kept).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd H = scale.asDiagonal() * part.H(kept, kept) * scale.asDiagonal();
  H.diagonal().array() += kSmall;
  const VectorXd b = scale.cwiseProduct(part.b(kept));
  VectorXd x = VectorXd::Zero(part.b.size());
  x(kept) = scale.cwiseProduct(VectorXd(Eigen::LDLT<MatrixXd>(H).solve(b)));
  return x;
}

VectorXd UnseenRows::Residuals(const Way& way, const std::vector<int>& dropped, bool raw) const {
  const Rows& rows = way.test ? (raw ? test_raw_ : test_white_) : (raw ? raw_ : white_);
  const std::vector<int> kept = Kept(dropped);
  VectorXd residuals = VectorXd::Zero(rows.y.size());
  for (const Part& part : way.parts) {
    const VectorXd x = Solve(part, kept);
    for (const int row : part.predicted) residuals[row] = rows.y[row] - rows.A.row(row).dot(x);
  }
  return residuals;
}

namespace {

double RmsOfLengths(const VectorXd& residuals, int coordinates) {
  double squares = 0, count = 0;
  for (Index k = 0; k < residuals.size(); ++k) {
    if (k % coordinates >= 3) continue;
    squares += residuals[k] * residuals[k];
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double UnseenRows::FittedRms(const std::vector<int>& dropped) const {
  return RmsOfLengths(raw_.y - raw_.A * Solve(all_, Kept(dropped)), coordinates_);
}

double UnseenRows::RmsOfStatedMasses(const std::vector<int>& dropped) const {
  std::vector<int> kept = Kept(dropped);
  const Index first_mass = all_.b.size() - mass_value_.size();
  kept.erase(std::lower_bound(kept.begin(), kept.end(), first_mass), kept.end());
  // The rows are linear at the fitted masses: those stated are a step back from there.
  VectorXd step = VectorXd::Zero(all_.b.size());
  step.tail(mass_value_.size()) = -mass_value_;
  Part stated;
  stated.H = all_.H;
  stated.b = all_.b - all_.H * step;
  return RmsOfLengths(raw_.y - raw_.A * (step + Solve(stated, kept)), coordinates_);
}

double UnseenRows::RmsOfWay(const Way& way, const std::vector<int>& dropped) const {
  return RmsOfLengths(Residuals(way, dropped, true), coordinates_);
}

double UnseenRows::UnseenRms(const std::vector<int>& dropped) const {
  return RmsOfWay(ways_[announced_], dropped);
}

UnseenRows::Gain UnseenRows::GainOf(const std::vector<int>& group, int way) const {
  const Way& chosen = ways_[static_cast<std::size_t>(way)];
  const VectorXd with = Residuals(chosen, {}, false);
  const VectorXd without = Residuals(chosen, group, false);
  const Index readings = with.size() / coordinates_;
  VectorXd gains(readings);
  for (Index k = 0; k < readings; ++k) {
    const Index first = k * coordinates_;
    gains[k] = 0.5 * (BoundedSquare(without.segment(first, coordinates_).squaredNorm()) -
                      BoundedSquare(with.segment(first, coordinates_).squaredNorm()));
  }
  Gain gain;
  gain.sum = gains.sum();
  gain.error = readings > 1 ? std::sqrt((gains.array() - gains.mean()).square().sum()) : 0;
  return gain;
}

bool UnseenRows::SpeakAgainst(const std::vector<int>& group) const {
  const bool scanned = std::any_of(
      group.begin(), group.end(), [&](int m) { return scanned_[static_cast<std::size_t>(m)]; });
  for (int way = 0; way < num_ways(); ++way) {
    const Gain gain = GainOf(group, way);
    if (gain.sum > (scanned ? 0.0 : -kTuning.unseen_errors * gain.error)) return false;
  }
  return num_ways() > 0;
}

}  // namespace dhcal
