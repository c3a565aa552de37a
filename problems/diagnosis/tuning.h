// The numbers of a diagnosis that decide verdicts, in one place: what each means, where it is from.
// `dhcal_study --vary` halves and doubles each and counts the answers that change.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_TUNING_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_TUNING_H_

namespace dhcal {

struct Tuning {
  // Rows.
  /// A reading further from the model than this many robust standard deviations is set aside; 4.5
  /// loses one good coordinate in 150,000.
  double outlier_sigmas = 4.5;
  /// At most this share of the readings is set aside, the worst first: a model that fails more is
  /// wrong itself.
  double most_outliers = 0.2;
  /// Repeats are put together where they leave at most this share of the rows.
  double repeats_share = 0.5;
  /// Noise that wanders or that enters by the joints is taken for such where it is likelier than
  /// white noise by this much (twice the logarithm): white noise comes up to it once in 1,000
  /// recordings.
  double noise_evidence = 14;
  /// A stated noise is not relied on where what is left has at most this share of its variance, and
  /// chance leaves so little less than once in so many recordings.
  double overstated = 0.6;
  double overstated_p = 1e-6;
  /// Readings that are searched, evenly over a longer recording; the last fit uses all.
  int most_searched = 3000;

  // Start: blocks that are taken into the first, robust model.
  int start_blocks = 8;
  double start_p = 1e-7;

  // Joint fit: what manufacture and set-up leave open, one standard deviation. They grow with the
  // square root of the misfit, so that a model that lacks much is not held by them.
  double prior_angle = 10e-3;   // [rad] rows
  double prior_length = 5e-3;   // [m] rows
  double prior_frame = 300e-3;  // [rad], [m] base and tool: forgotten ones are as long
  double mass_error = 0.25;     // of a stated mass
  double centre_error = 0.03;   // [m] of a stated centre of mass
  double guessed_mass = 0.7;    // the same where the masses are guessed
  double guessed_centre = 0.12;

  // Search.
  int beam = 6;
  int most_members = 14;  // a real arm has six to twelve things at once
  int rounds = 4;         // of search, joint fit and outliers
  /// A parameter may be ten times its usual size for one unit of evidence (chi-square).
  double size_decades = 1;
  /// Beyond this many usual sizes a name is no explanation, unless without it the misfit is
  /// `unmistakable` times as large: then the robot is unusual, not the name.
  double largest_size = 100;
  /// Evidence by which a free function must be better than a name.
  double unnamed_charge = 5;
  /// Sets this close to the best (in chi-square, as BIC counts) are not told apart: odds of 1 to
  /// 150.
  double list_margin = 10;
  int longest_list = 12;

  // Judgement.
  /// Robust variance in units of the stated one, with no structure, from which something is said to
  /// be unexplained: two and a half stated sigmas. Below, the stated sigma itself is doubted.
  double restless = 6.25;
  double predictive_bound = 25;  // squares of one unseen reading that count in full
  double unseen_errors = 2;      // standard errors by which unseen rows must speak against a name
  // Times the error without it: a driver that nobody knows keeps its name beside a rest, and an
  // effect of an unheard-of size its name, only if it is worth as much. Columns of real tracker
  // data go along with the rest and are worth little.
  double unmistakable = 1.5;
  /// Of what a name for a joint's angle moves: unnamed things at that joint that move as much make
  /// the name their shadow. Real joints' curves have ten times their rest.
  double shadow = 0.5;
  double least_certain = 2;  // standard deviations that a finding's value is from zero
};

namespace internal {
/// Written by `dhcal_study --vary` alone, and never while a diagnosis runs.
inline Tuning tuning_in_force;
}  // namespace internal

inline constexpr const Tuning& kTuning = internal::tuning_in_force;

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_TUNING_H_
