#include "core/analysis/block_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <glog/logging.h>

#include "core/base/rng.h"
#include "core/math/pseudo_root.h"
#include "core/math/statistics.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Beyond this score no draw comes near; the model is rejected without simulating.
constexpr double kFarOut = 9.0;
constexpr int kMostSoft = 200;
// A probability this far from the level by the geometry's draws is on its side of it.
constexpr double kClear = 3.0;

}  // namespace

BlockTests::BlockTests(BlockGram gram,
                       std::vector<ColumnRange> blocks,
                       std::vector<bool> in_maximum,
                       int draws,
                       std::uint64_t seed,
                       const BlockTests* before)
    : gram_(std::move(gram)),
      blocks_(std::move(blocks)),
      in_maximum_(std::move(in_maximum)),
      draws_(draws),
      seed_(seed) {
  CHECK_EQ(blocks_.size(), in_maximum_.size());
  if (before != nullptr) {
    geometry_maxima_ = before->geometry_maxima_;
    return;
  }
  const Conditioned geometry = Condition({});
  std::vector<MatrixXd> factors(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (in_maximum_[b]) factors[b] = Factor(geometry, static_cast<int>(b));
  }
  geometry_maxima_ = NullMaxima({}, geometry, factors);
  std::sort(geometry_maxima_.begin(), geometry_maxima_.end());
}

void BlockTests::Simulate() const {
  Rng rng(seed_);
  const bool over_rows = gram_.rows.rows() > 0;
  MatrixXd normal(over_rows ? gram_.rows.rows() : gram_.S.rows(), draws_);
  for (double& value : normal.reshaped()) value = rng.Normal();
  if (over_rows) {
    draws_z_ = gram_.rows.transpose() * normal;
    draws_rss_ = (normal.colwise().squaredNorm() -
                  (gram_.basis.transpose() * normal).colwise().squaredNorm())
                     .transpose();
    if (gram_.offsets.cols() > 0) {
      draws_rss_ -=
          MatrixXd(gram_.offsets.transpose() * normal).colwise().squaredNorm().transpose();
    }
    gram_.rows.resize(0, 0);
    gram_.basis.resize(0, 0);
  } else {
    // Columns of unit length; the small addition keeps nearly equal columns from failing.
    constexpr double kAddition = 1e-8;
    const VectorXd length = gram_.S.diagonal().cwiseMax(1e-300).cwiseSqrt();
    MatrixXd scaled =
        length.cwiseInverse().asDiagonal() * gram_.S * length.cwiseInverse().asDiagonal();
    scaled.diagonal().array() += kAddition;
    const Eigen::LLT<MatrixXd> llt(scaled);
    if (llt.info() != Eigen::Success) {
      throw std::runtime_error("the Gram matrix of the tested columns has no Cholesky factor");
    }
    draws_z_ = length.asDiagonal() * (llt.matrixL() * normal);
    draws_rss_ = normal.colwise().squaredNorm().transpose();
    const double rest = gram_.nu - static_cast<double>(gram_.S.rows());
    if (!(rest > 0)) throw std::runtime_error("more tested columns than the rows have freedom");
    boost::random::mt19937_64 engine(seed_ + 1);
    boost::random::chi_squared_distribution<double> chi_square(rest);
    for (double& value : draws_rss_) value += chi_square(engine);
  }
  draws_soft_.resize(kMostSoft, draws_);
  for (double& value : draws_soft_.reshaped()) value = rng.Normal();
}

std::vector<int> BlockTests::AllBlocks() const {
  std::vector<int> all(blocks_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> BlockTests::Columns(int block) const {
  const ColumnRange& range = blocks_[static_cast<std::size_t>(block)];
  std::vector<int> columns;
  for (int k = 0; k < range.size; ++k) columns.push_back(range.first + k);
  return columns;
}

BlockTests::Root BlockTests::RootOf(const BlockModel& model) const {
  Root root;
  root.columns = model.columns;
  root.columns.insert(root.columns.end(), model.soft.begin(), model.soft.end());
  if (root.columns.empty()) {
    root.F.resize(0, 0);
    return root;
  }
  MatrixXd S_AA = gram_.S(root.columns, root.columns);
  VectorXd norm2 = gram_.norm2(root.columns);
  const auto hard = static_cast<Index>(model.columns.size());
  for (Index k = 0; k < static_cast<Index>(model.soft.size()); ++k) {
    const double precision = 1 / std::max(model.soft_sigma[k] * model.soft_sigma[k], 1e-300);
    S_AA(hard + k, hard + k) += precision;
    norm2[hard + k] += precision;
  }
  root.F = PseudoRoot(S_AA, norm2);
  return root;
}

BlockTests::Conditioned BlockTests::Condition(const BlockModel& model) const {
  return Condition(model, AllBlocks());
}

BlockTests::Conditioned BlockTests::Condition(const BlockModel& model,
                                              const std::vector<int>& blocks) const {
  Conditioned c;
  static_cast<Root&>(c) = RootOf(model);
  c.rss = gram_.rss;
  c.nu = gram_.nu;
  c.z = gram_.z;
  c.G.resize(0, gram_.S.cols());
  if (c.columns.empty()) return c;
  c.G.setZero(c.F.cols(), gram_.S.cols());
  if (blocks.size() == blocks_.size()) {
    c.G.noalias() = c.F.transpose() * gram_.S(c.columns, Eigen::all);
  } else {
    for (const int block : blocks) {
      const ColumnRange& range = blocks_[static_cast<std::size_t>(block)];
      c.G.middleCols(range.first, range.size) =
          c.F.transpose() * gram_.S(c.columns, Eigen::seqN(range.first, range.size));
    }
  }
  const VectorXd projected = c.F.transpose() * gram_.z(c.columns);
  c.z -= c.G.transpose() * projected;
  c.rss = std::max(c.rss - projected.squaredNorm(), 0.0);
  // Soft columns take no freedom: their coefficients are part of the noise.
  const Index rank = c.F.cols() - static_cast<Index>(model.soft.size());
  c.nu -= static_cast<double>(std::max<Index>(rank, 0));
  return c;
}

MatrixXd BlockTests::ConditionalS(const Conditioned& c, int row_block, int col_block) const {
  const ColumnRange& r = blocks_[static_cast<std::size_t>(row_block)];
  const ColumnRange& s = blocks_[static_cast<std::size_t>(col_block)];
  MatrixXd S = gram_.S.block(r.first, s.first, r.size, s.size);
  if (c.G.rows() > 0) {
    S -= c.G.middleCols(r.first, r.size).transpose() * c.G.middleCols(s.first, s.size);
  }
  return S;
}

MatrixXd BlockTests::Factor(const Conditioned& c, int block) const {
  const ColumnRange& range = blocks_[static_cast<std::size_t>(block)];
  return PseudoRoot(ConditionalS(c, block, block), gram_.norm2.segment(range.first, range.size));
}

double BlockTests::NormalScore(double Q, int k, double rss, double nu) const {
  if (gram_.sigma_known) return ChiSquareScore(Q / k, k);
  const double rest = nu - k;
  if (rest < 1) return 0;
  const double noise = std::max(rss - Q, 1e-300) / rest;
  return FScore(Q / k / noise, k, rest);
}

double BlockTests::LackOfFit(double rss, double nu) const {
  return gram_.sigma_known && nu > 0 ? ChiSquareScore(rss / nu, nu) : -1e300;
}

BlockScore BlockTests::ScoreOf(const Conditioned& c, int block) const {
  const MatrixXd factor = Factor(c, block);
  BlockScore score;
  score.k = static_cast<int>(factor.cols());
  if (score.k == 0) return score;
  const ColumnRange& range = blocks_[static_cast<std::size_t>(block)];
  score.Q = (factor.transpose() * c.z.segment(range.first, range.size)).squaredNorm();
  score.z = NormalScore(score.Q, score.k, c.rss, c.nu);
  score.p = RemovalTail(score.Q, score.k, c.rss, c.nu, gram_.sigma_known);
  return score;
}

std::vector<BlockScore> BlockTests::Scores(const BlockModel& model) const {
  return Scores(model, AllBlocks());
}

std::vector<BlockScore> BlockTests::Scores(const BlockModel& model,
                                           const std::vector<int>& blocks) const {
  const Conditioned c = Condition(model, blocks);
  std::vector<BlockScore> scores;
  for (const int b : blocks) scores.push_back(ScoreOf(c, b));
  return scores;
}

BlockScore BlockTests::Score(const BlockModel& model, int block) const {
  return ScoreOf(Condition(model, {block}), block);
}

std::vector<double> BlockTests::Chances(const BlockModel& model,
                                        const std::vector<int>& blocks,
                                        int together) const {
  const Conditioned c = Condition(model, blocks);
  std::vector<double> chances;
  for (const int block : blocks) {
    const BlockScore score = ScoreOf(c, block);
    chances.push_back(RemovalTail(score.Q, score.k, c.rss, c.nu / together));
  }
  return chances;
}

ModelTest BlockTests::Test(const BlockModel& model, double level, const VectorXd& excused) const {
  const Conditioned c = Condition(model);
  ModelTest test;
  test.rss = c.rss;
  test.nu = c.nu;
  test.T = LackOfFit(c.rss, c.nu);
  std::vector<MatrixXd> factors(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!in_maximum_[b]) continue;
    factors[b] = Factor(c, static_cast<int>(b));
    if (factors[b].cols() == 0) continue;
    const ColumnRange& range = blocks_[b];
    const double Q = (factors[b].transpose() * c.z.segment(range.first, range.size)).squaredNorm();
    if (excused.size() > 0 && Q < excused[static_cast<Index>(b)]) continue;
    const double score = NormalScore(Q, static_cast<int>(factors[b].cols()), c.rss, c.nu);
    if (score > test.T) {
      test.T = score;
      test.worst = static_cast<int>(b);
    }
  }
  const auto draws = static_cast<double>(draws_);
  if (test.T > kFarOut) {
    test.p = 1 / (draws + 1);
    return test;
  }
  const auto probability = [&](const std::vector<double>& maxima) {
    const auto above =
        std::count_if(maxima.begin(), maxima.end(), [&](double T) { return T >= test.T; });
    return (1 + static_cast<double>(above)) / (draws + 1);
  };
  test.p = probability(geometry_maxima_);
  const bool decided = test.p > kClear * level || test.p < level / kClear;
  if (!model.columns.empty() && !decided) test.p = probability(NullMaxima(model, c, factors));
  return test;
}

bool BlockTests::MayFit(const BlockModel& model,
                        const std::vector<int>& order,
                        double limit,
                        const VectorXd& excused) const {
  const Conditioned c = Condition(model);
  if (LackOfFit(c.rss, c.nu) > limit) return false;
  for (const int b : order) {
    if (!in_maximum_[static_cast<std::size_t>(b)]) continue;
    const MatrixXd factor = Factor(c, b);
    if (factor.cols() == 0) continue;
    const ColumnRange& range = blocks_[static_cast<std::size_t>(b)];
    const double Q = (factor.transpose() * c.z.segment(range.first, range.size)).squaredNorm();
    if (excused.size() > 0 && Q < excused[b]) continue;
    if (NormalScore(Q, static_cast<int>(factor.cols()), c.rss, c.nu) > limit) return false;
  }
  return true;
}

std::vector<double> BlockTests::NullMaxima(const BlockModel& model,
                                           const Conditioned& c,
                                           const std::vector<MatrixXd>& factors) const {
  if (draws_rss_.size() == 0) Simulate();
  MatrixXd z = draws_z_;
  VectorXd rss = draws_rss_;
  if (!c.columns.empty()) {
    const auto num_soft = std::min<Index>(static_cast<Index>(model.soft.size()), kMostSoft);
    if (num_soft > 0) {
      // A soft column's coefficient is drawn anew in each draw; its rows join the residual.
      const std::vector<int> soft(model.soft.begin(), model.soft.begin() + num_soft);
      const MatrixXd coefficients =
          model.soft_sigma.head(num_soft).asDiagonal() * draws_soft_.topRows(num_soft);
      const MatrixXd S_soft = gram_.S(Eigen::all, soft);
      rss +=
          2 * (draws_z_(soft, Eigen::all).cwiseProduct(coefficients)).colwise().sum().transpose();
      rss += (coefficients.cwiseProduct(S_soft(soft, Eigen::all) * coefficients))
                 .colwise()
                 .sum()
                 .transpose();
      z += S_soft * coefficients;
    }
    const MatrixXd projected = c.F.transpose() * z(c.columns, Eigen::all);
    z -= c.G.transpose() * projected;
    rss -= projected.colwise().squaredNorm().transpose();
  }
  std::vector<double> maxima(static_cast<std::size_t>(rss.size()));
  for (Index d = 0; d < rss.size(); ++d) {
    maxima[static_cast<std::size_t>(d)] = LackOfFit(rss[d], c.nu);
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!in_maximum_[b] || factors[b].cols() == 0) continue;
    const ColumnRange& range = blocks_[b];
    const Eigen::RowVectorXd Q =
        (factors[b].transpose() * z.middleRows(range.first, range.size)).colwise().squaredNorm();
    for (Index d = 0; d < Q.size(); ++d) {
      double& maximum = maxima[static_cast<std::size_t>(d)];
      maximum =
          std::max(maximum, NormalScore(Q[d], static_cast<int>(factors[b].cols()), rss[d], c.nu));
    }
  }
  return maxima;
}

VectorXd BlockTests::Estimate(const BlockModel& model) const {
  const Root root = RootOf(model);
  return (root.F * (root.F.transpose() * gram_.z(root.columns)))
      .head(static_cast<Index>(model.columns.size()));
}

double BlockTests::Removed(const BlockModel& model) const {
  const Root root = RootOf(model);
  return (root.F.transpose() * gram_.z(root.columns)).squaredNorm();
}

}  // namespace dhcal
