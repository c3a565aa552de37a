// Quantiles and tail probabilities (Boost.Math) and robust scale.
#ifndef DHCAL_CORE_MATH_STATISTICS_H_
#define DHCAL_CORE_MATH_STATISTICS_H_

#include <vector>

namespace dhcal {

/// Two-sided quantile of Student's t: P(|t| <= result) = `confidence`. With `dof` infinite it is
/// the normal's.
double StudentTwoSided(double confidence, double dof);

/// P(chi-square with `dof` degrees of freedom > x). For the tails here: 0 at an infinite x; 1, no
/// evidence, where x is no number or there is no freedom.
double ChiSquareTail(double x, double dof);

/// x with P(chi-square with `dof` degrees of freedom, a whole number or not, < x) = `probability`.
double ChiSquareQuantile(double probability, double dof);

/// P(F with `k` and `nu` degrees of freedom > x).
double FTail(double x, double k, double nu);

/// Probability that `k` columns remove `Q` or more of the squares `rss` by chance; `nu`: freedom
/// before them. With noise of unit size that of chi-square; else what they leave is noise of
/// unknown size, and one is the answer where nothing is left to judge by.
double RemovalTail(double Q, double k, double rss, double nu, bool sigma_known = false);

/// Logarithms of the same tails, finite where the probabilities are below the smallest number.
double LogChiSquareTail(double x, double dof);
double LogFTail(double x, double k, double nu);

/// The standard normal score (finite; the lowest where the statistic is no number) of a chi-square
/// variable with `dof` degrees of freedom, given as its
/// mean square x / dof (Wilson and Hilferty 1931).
double ChiSquareScore(double mean_square, double dof);

/// The standard normal score of an F variable with `k` and `nu` degrees of freedom (Paulson 1942).
double FScore(double F, double k, double nu);

/// Median; NaN when empty.
double Median(std::vector<double> values);

/// 1.4826 * median of |values|: the standard deviation, were they normal with mean zero.
double RobustScale(std::vector<double> values);

}  // namespace dhcal

#endif  // DHCAL_CORE_MATH_STATISTICS_H_
