// How well sets of items describe the rows, from a small Gram matrix: with the geometry (and what
// else is free) taken out,
//
//   G = C'MC,  b = C'My,  rss = y'My
//
// hold all that is needed, so that a set costs the same whatever the number of rows.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_GRAM_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_GRAM_H_

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace dhcal {

/// Squares that columns remove, from their Gram matrix `block` and products `b` beside what is
/// taken out; columns that are as good as gone beside it are left out. `norm2`: their squares
/// before.
double SquaresRemoved(Eigen::MatrixXd block,
                      Eigen::VectorXd b,
                      const Eigen::Ref<const Eigen::VectorXd>& norm2);

/// How squares left over, parameters and choices are weighed against each other; in the units of
/// chi-square, smaller is better.
struct EvidenceRule {
  bool sigma_known = false;
  double dof = 1;    // of the rows beside the geometry, in independent draws
  double poses = 1;  // that differ: what a parameter's price counts
  int names = 1;     // that a name is chosen from

  /// Squares left, as evidence: with a known sigma chi-square less its mean, but only its logarithm
  /// beyond that, since the excess is misfit and no noise; with an unknown sigma dof ln(variance).
  double Loss(double rss) const;
  /// Price of an item: BIC's for its parameters, and the choice of its form and its name.
  double Price(int parameters, int variants, bool chosen_name) const;
};

struct GramItem {
  std::string id;
  int first = 0, size = 0;  // columns
  int variants = 1;
  bool unnamed = false;        // a free function: a name that does nearly as well comes before it
  bool chosen_name = true;     // false: one of very few (a completion), whose choice costs nothing
  std::string taken_for;       // class of names that it is easily taken for; empty = none
  std::vector<bool> positive;  // per column: negative values are impossible
  Eigen::VectorXd typical;     // usual size per column; empty = none is unusual
};

struct Gram {
  Eigen::MatrixXd G;
  Eigen::VectorXd b;
  Eigen::VectorXd norm2;  // of each column before anything was taken out
  double rss = 0;
};

/// A set of items (positions, ascending).
using ItemSet = std::vector<int>;

struct SetValue {
  double evidence = 0;
  double rss = 0;
  std::vector<Eigen::VectorXd> values;  // of each item, in the set's order
};

/// Remembers what it has evaluated.
class SetEvaluator {
 public:
  SetEvaluator(Gram gram, std::vector<GramItem> items, const EvidenceRule& rule);

  const std::vector<GramItem>& items() const { return items_; }
  const EvidenceRule& rule() const { return rule_; }
  double price(int item) const { return price_[static_cast<std::size_t>(item)]; }

  /// What the evidence of a set would be if a parameter cost as much as it takes of noise, 2
  /// (Akaike 1974), instead of the logarithm of the poses.
  double FrugalEvidence(const ItemSet& set);

  /// Least squares with the signs that the items allow, sizes weighed.
  const SetValue& Evaluate(const ItemSet& set);

  /// Sets with one more item than `base`, and (with `pairs`) two more, that promise most; by a free
  /// least-squares estimate.
  struct Promise {
    double evidence = 0;
    ItemSet set;
  };
  std::vector<Promise> Larger(const ItemSet& base, bool pairs) const;

 private:
  struct Beside;
  Beside Condition(const ItemSet& base) const;
  double Gain(const Eigen::MatrixXd& block, const Eigen::VectorXd& b, int item) const;

  Gram gram_;
  std::vector<GramItem> items_;
  EvidenceRule rule_;
  std::vector<double> price_;
  std::vector<int> visible_;  // columns of each item that the geometry leaves
  std::map<ItemSet, SetValue> known_;
};

/// `set` with an item more, in order.
ItemSet With(ItemSet set, int item);
/// `set` without some of its items.
ItemSet Without(const ItemSet& set, const ItemSet& removed);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_SEARCH_GRAM_H_
