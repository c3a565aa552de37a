// Tests sets of named hypotheses against everything else that the space holds.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_SET_TESTER_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_SET_TESTER_H_

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/analysis/block_tests.h"
#include "problems/diagnosis/hypotheses.h"
#include "problems/diagnosis/search.h"
#include "problems/diagnosis/spectrum.h"

namespace dhcal {

/// Family-wise probability of the block tests' and the order scan's together. The scan has a fifth
/// of the error rate: its p is a bound, which for most recordings is far from reached.
double Combine(double p_blocks, double p_scan);

class SetTester {
 public:
  /// Both must outlive the tester.
  SetTester(const SearchOptions& options, HypothesisSpace* space);

  /// Takes up hypotheses that were added to the space.
  void Rebuild();

  const BlockTests& tests() const { return *tests_; }
  /// Hypotheses that may be named.
  const std::vector<int>& names() const { return names_; }
  const Hypothesis& at(int idx) const { return space_->all()[static_cast<std::size_t>(idx)]; }
  /// The model of a set of names: their columns, and the errors of their shapes in proportion to
  /// their estimated size.
  BlockModel Model(const std::vector<int>& members) const;

  /// What stands for wrong masses is left out of every model from now on, or taken in again.
  void TakeShapesAsStated(bool as_stated) { shapes_as_stated_ = as_stated; }
  /// Tests a set; a hopeless one at small cost. `rescan`: a set that passes is also held against a
  /// new scan of the orders.
  TestedSet Try(const std::vector<int>& members, bool rescan) const;
  /// Evidence for what removes `removed` of the squares `rss`, before its price.
  double Gain(double removed, double rss) const;
  /// Evidence of a set: squares removed against the price of its columns (BIC; larger is better).
  double Evidence(const std::vector<int>& members) const;
  /// True when a hypothesis stands for the same as a member: same effect and place with another
  /// setting, but for several gear orders or driving joints.
  bool Conflicts(int hypothesis, const std::vector<int>& members) const;

  /// True for a line or other function of its joint's own angle that the joint's error curve holds.
  bool InCurve(int hypothesis) const;

  /// Highest peak of each joint beside the members.
  std::vector<SpectralPeak> Scan(const std::vector<int>& members) const;
  /// Probability under noise that the scan's highest line has this p or less.
  double ScanChance(double p) const { return ScanProbability(p, scan_width_); }
  static double LeastScan(const std::vector<SpectralPeak>& peaks);
  /// Evidence of the members with a peak found beside them.
  double EvidenceWith(const SpectralPeak& peak, const std::vector<int>& members) const;
  /// The error curve of a joint as a hypothesis; -1 where it cannot be tested or named.
  int Curve(int joint);
  /// A name, added to the space where it is new (`Rebuild` takes it up); -1 where it may not be
  /// given or cannot be tested.
  int Known(const EffectRequest& request);
  /// Significant peaks that are new become hypotheses; true when there is one.
  bool AddPeaks(const std::vector<SpectralPeak>& peaks, const std::vector<int>& members);
  /// Families with an instant or a time constant that the rows ask for most get the best one.
  void AddRefined(const std::vector<int>& members);
  /// The members with their orders, instants and time constants refined beside each other: found
  /// one after the other, each was found with the later ones still in its way.
  std::vector<int> Polished(std::vector<int> members);

 private:
  /// What a hypothesis costs in evidence; `noise`: variance of a whitened row.
  double Price(int hypothesis, double noise) const;
  bool MayBeNamed(const std::string& effect) const;
  /// What a model may leave of each block without being rejected.
  Eigen::VectorXd Excused(const BlockModel& model, const std::vector<int>& members) const;
  /// Orthonormal basis of the members' columns beside the geometry, kept from one call to the next:
  /// a search asks for one that grows.
  const Eigen::MatrixXd& Basis(const std::vector<int>& members) const;
  /// Probability of the highest of the spectrum's known lines beside a model, for the whole scan.
  double LinesLeft(const BlockModel& model) const;

  const SearchOptions& options_;
  HypothesisSpace* space_;
  std::unique_ptr<BlockTests> tests_;
  std::vector<int> names_;
  std::vector<int> order_;  // blocks, highest score beside the geometry first
  std::vector<int> lines_;  // hypotheses that a scan found
  double scan_width_;
  bool shapes_as_stated_ = false;
  mutable std::vector<int> basis_members_;
  mutable std::map<int, Eigen::VectorXd> curve_squares_;  // eigenvalues of curves' Gram matrices
  mutable Eigen::MatrixXd basis_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_SET_TESTER_H_
