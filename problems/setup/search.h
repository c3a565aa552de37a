// Tries all ways to take two files that a few causes make, on a few rows, and keeps those under
// which the nominal robot fits.
#ifndef DHCAL_PROBLEMS_SETUP_SEARCH_H_
#define DHCAL_PROBLEMS_SETUP_SEARCH_H_

#include <vector>

#include "core/model/reading.h"
#include "problems/calibration.h"
#include "problems/setup/cause.h"
#include "problems/setup/frames_fit.h"

namespace dhcal {

struct Candidate {
  SetUp set_up;
  FramesMisfit misfit;
  int weight = 0;
};

/// Bound to files, calibration and readings, which must outlive it. Immutable.
class SetUpSearch {
 public:
  /// `readings`: those that are looked at; a few of them are taken, evenly.
  SetUpSearch(const Files& files,
              const Calibration& calibration,
              const std::vector<Reading>& readings);

  /// False where the readings are too few to tell anything.
  bool possible() const { return !readings_.empty(); }
  /// Completes `set_up` by what the fit finds: units and mirrored frames.
  Candidate Judge(SetUp set_up) const;
  /// The zero of one joint off by the angle that fits best, alone or with one step beside it: those
  /// that fit nearly as well as the best, each without a change that it can do without. For where
  /// no steps help.
  std::vector<Candidate> Remastered() const;
  /// Set-ups that fit nearly as well as the best found, each without a change that it can do
  /// without; fewest causes first, then the best fit.
  std::vector<Candidate> Run() const;

 private:
  std::vector<Candidate> JudgeAll(const std::vector<SetUp>& set_ups) const;
  /// Set-ups of one step from `from`, of all kinds.
  std::vector<SetUp> Steps(const SetUp& from) const;
  std::vector<SetUp> Seeds() const;
  /// Moves the zero of the one joint that is off to where it fits best.
  void RefineZero(int joint_idx, Candidate* candidate) const;
  /// The best, each simplified and once; fewest causes first, then the best fit. `sorted`: best
  /// first.
  std::vector<Candidate> Kept(const std::vector<Candidate>& sorted) const;
  /// Ways to come from a candidate to one as good with fewer causes.
  void Simplify(Candidate* candidate) const;

  const Files files_;
  std::vector<Reading> readings_;
  FramesFit fit_;
  std::vector<FlangeOfRows> now_, before_;  // for each shift, from the smallest
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_SEARCH_H_
