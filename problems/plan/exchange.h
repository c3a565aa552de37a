// Which of many candidates to measure: an exchange algorithm (Fedorov 1972) on blocks of rows.
//
//   M = I + sum over chosen of A'A          columns in tolerances: I is what the tolerances know
//   D: largest log det M                    the smallest confidence ellipsoid of the parameters
//   I: smallest trace(W M^-1)               the smallest prediction variance, W = J'J / points
//
// A greedy start, then each chosen candidate gives way to the best that is not chosen, until none
// of them gains.
#ifndef DHCAL_PROBLEMS_PLAN_EXCHANGE_H_
#define DHCAL_PROBLEMS_PLAN_EXCHANGE_H_

#include <vector>

#include <Eigen/Core>

namespace dhcal {

enum class DesignCriterion { kD, kI };

class Exchange {
 public:
  /// `blocks`: rows A of every candidate. `weights`: W, for the criterion I. Both must outlive it.
  Exchange(const std::vector<Eigen::MatrixXd>& blocks,
           DesignCriterion criterion,
           const Eigen::MatrixXd& weights);

  /// Brings the choice to `count` candidates (at most all), each once, and improves it.
  void Choose(int count);

  const std::vector<int>& chosen() const { return chosen_; }
  /// M^-1 of the choice, in tolerances.
  const Eigen::MatrixXd& covariance() const { return V_; }

 private:
  double GainOf(int candidate) const;
  int BestFree() const;
  void Add(int candidate);
  void Remove(std::size_t place);
  bool Improve();
  void Recompute();

  const std::vector<Eigen::MatrixXd>& blocks_;
  DesignCriterion criterion_;
  const Eigen::MatrixXd& weights_;
  std::vector<int> chosen_;
  std::vector<bool> taken_;
  Eigen::MatrixXd V_;
  Eigen::MatrixXd VWV_;  // V W V, for the criterion I
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PLAN_EXCHANGE_H_
