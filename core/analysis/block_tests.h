// Which columns does the residual ask for? Score tests of many blocks of columns at once, from a
// small Gram matrix, with a Monte-Carlo calibrated maximum.
//
// All rows are whitened and projected off the geometry (M). With X the columns of all blocks,
//   S = X' M X,  z = X' M y,  rss = y' M y,  nu = rows - rank of the geometry
// hold all that the tests need: their cost does not depend on the number of rows. PHYSICS.md M1;
// the confidence set over hypotheses is M3.
#ifndef DHCAL_CORE_ANALYSIS_BLOCK_TESTS_H_
#define DHCAL_CORE_ANALYSIS_BLOCK_TESTS_H_

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dhcal {

struct BlockGram {
  Eigen::MatrixXd S;
  Eigen::VectorXd z;
  Eigen::VectorXd norm2;  // x'x of each column before the projection
  double rss = 0;
  double nu = 0;
  /// With few rows the draws are made over them: then there may be more columns than freedom, and S
  /// has no Cholesky factor. X projected, and the geometry's basis; empty = draw from S.
  Eigen::MatrixXd rows, basis;
  /// What else was taken out of y and X, beside that basis: orthonormal columns, orthogonal to it;
  /// may be empty. Used with `rows` only.
  Eigen::SparseMatrix<double> offsets;
  bool sigma_known = false;  // rows are whitened by a known sigma (else only up to a factor)
};

/// Columns of one block.
struct ColumnRange {
  int first = 0;
  int size = 0;
};

/// What is fitted besides the geometry. Soft columns are nuisances of known spread: coefficients
/// are normal with these standard deviations (in the units of the whitened rows).
struct BlockModel {
  std::vector<int> columns;
  std::vector<int> soft;
  Eigen::VectorXd soft_sigma;
};

struct BlockScore {
  double Q = 0;  // squares that the block would remove
  int k = 0;     // columns that can be told from the model
  double z = 0;  // normal score of the test, large = asked for
  double p = 1;  // of this block alone
};

struct ModelTest {
  double T = 0;    // largest score
  int worst = -1;  // block that has it; -1 = the lack of fit against the known sigma
  double p = 1;    // Monte-Carlo probability of T or more under the model
  double rss = 0;  // left
  double nu = 0;
};

class BlockTests {
 public:
  /// `blocks` are all scored; those of `in_maximum` decide T. `before` (may be null): tests of the
  /// same rows with the same blocks in the maximum and fewer others, whose law of the maximum holds
  /// here too; new draws are then made only when a test needs them.
  BlockTests(BlockGram gram,
             std::vector<ColumnRange> blocks,
             std::vector<bool> in_maximum,
             int draws,
             std::uint64_t seed,
             const BlockTests* before = nullptr);

  const BlockGram& gram() const { return gram_; }
  const std::vector<ColumnRange>& blocks() const { return blocks_; }
  std::vector<int> Columns(int block) const;

  /// Score of every block beside the model.
  std::vector<BlockScore> Scores(const BlockModel& model) const;
  /// Of some blocks, in their order.
  std::vector<BlockScore> Scores(const BlockModel& model, const std::vector<int>& blocks) const;
  BlockScore Score(const BlockModel& model, int block) const;

  /// Of each block, the probability that it removes as many squares as it does beside the model
  /// where all that the two leave is noise of unknown size (F test), whether or not sigma is known;
  /// `together` rows that follow each other err as one.
  std::vector<double> Chances(const BlockModel& model,
                              const std::vector<int>& blocks,
                              int together) const;

  /// Tests the model at a level. The law of the maximum hardly depends on the model, so draws under
  /// the model itself are made only where the geometry's draws do not decide. Blocks of `excused`
  /// (index -> largest Q that is immaterial) below their limit do not count.
  ModelTest Test(const BlockModel& model, double level, const Eigen::VectorXd& excused = {}) const;

  /// False when some block's score (in the order given) already exceeds `limit`.
  bool MayFit(const BlockModel& model,
              const std::vector<int>& order,
              double limit,
              const Eigen::VectorXd& excused) const;

  /// Coefficients of a model's columns, in units of the columns.
  Eigen::VectorXd Estimate(const BlockModel& model) const;
  /// Squares that the model's columns remove.
  double Removed(const BlockModel& model) const;

 private:
  /// F with F F' = pseudo-inverse of S_AA: A the model's columns, soft ones with their precision.
  struct Root {
    std::vector<int> columns;
    Eigen::MatrixXd F;
  };
  Root RootOf(const BlockModel& model) const;
  /// Everything beside a model: S|model = S - G'G, G = F' S_A,.
  struct Conditioned : Root {
    Eigen::MatrixXd G;
    Eigen::VectorXd z;
    double rss = 0, nu = 0;
  };
  void Simulate() const;
  std::vector<int> AllBlocks() const;
  Conditioned Condition(const BlockModel& model) const;
  /// The same with the columns of some blocks only.
  Conditioned Condition(const BlockModel& model, const std::vector<int>& blocks) const;
  /// E with Q = |E' z|^2 for a block; its columns count k.
  Eigen::MatrixXd Factor(const Conditioned& c, int block) const;
  Eigen::MatrixXd ConditionalS(const Conditioned& c, int row_block, int col_block) const;
  double NormalScore(double Q, int k, double rss, double nu) const;
  double LackOfFit(double rss, double nu) const;
  BlockScore ScoreOf(const Conditioned& c, int block) const;
  std::vector<double> NullMaxima(const BlockModel& model,
                                 const Conditioned& c,
                                 const std::vector<Eigen::MatrixXd>& factors) const;

  mutable BlockGram gram_;  // `rows` and `basis` go once the draws are made
  std::vector<ColumnRange> blocks_;
  std::vector<bool> in_maximum_;
  int draws_;
  std::uint64_t seed_;
  // Made when first asked for.
  mutable Eigen::MatrixXd draws_z_;    // columns x draws: X' M e
  mutable Eigen::VectorXd draws_rss_;  // e' M e
  mutable Eigen::MatrixXd draws_soft_;
  std::vector<double> geometry_maxima_;  // ascending
};

}  // namespace dhcal

#endif  // DHCAL_CORE_ANALYSIS_BLOCK_TESTS_H_
