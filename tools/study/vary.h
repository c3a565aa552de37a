// What the answers of a diagnosis owe to the numbers that decide (problems/diagnosis/tuning.h).
#ifndef DHCAL_TOOLS_STUDY_VARY_H_
#define DHCAL_TOOLS_STUDY_VARY_H_

#include <ostream>
#include <string>
#include <vector>

#include "problems/diagnosis/tuning.h"

namespace dhcal {

/// One number of `Tuning`: exactly one of the two members is set.
struct TuningNumber {
  std::string name;
  double Tuning::*real = nullptr;
  int Tuning::*count = nullptr;
};

/// All of them, in the order of the struct.
std::vector<TuningNumber> TuningNumbers();

/// `tuning` with one number multiplied; a count stays at least 1.
Tuning Varied(Tuning tuning, const TuningNumber& number, double factor);

/// A verdict that changes on more than this share of the cases says that a number needs a reason.
inline constexpr double kShareThatAsks = 0.02;

/// Draws of each scenario unless told otherwise: about an hour on two cores.
inline constexpr int kDrawsOfVary = 2;

/// Diagnoses `draws` draws (seeds 1, 2, ...) of every scenario with the numbers as they are, then
/// with each halved and doubled; prints a line per number: verdicts and sets of names that change.
/// Not beside another diagnosis: the numbers are the program's.
void PrintVaried(int draws, std::ostream* out);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_STUDY_VARY_H_
