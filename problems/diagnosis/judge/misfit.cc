#include "problems/diagnosis/judge/misfit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/math/statistics.h"
#include "problems/diagnosis/rows/misread_repeats.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {

void DescribeMisfit(const JointRows& before,
                    std::size_t num_readings,
                    const LoopOutcome& outcome,
                    const DistinctRows& distinct,
                    DiagnosisResult* d) {
  Misfit& misfit = d->misfit;
  misfit.noise_known = outcome.rule.sigma_known;
  if (distinct.averaged) {
    misfit.why_estimated = "the noise of poses that were read several times is not stated";
  } else if (outcome.overstated) {
    misfit.why_estimated = "the stated noise is larger than any chance leaves";
  }
  misfit.noise_sigma = outcome.noise.sigma;
  misfit.rows = static_cast<int>(num_readings);
  misfit.statistic = before.y().squaredNorm();
  misfit.dof = std::max<double>(
      1, before.rows->degrees_of_freedom() - static_cast<double>(before.free.size()));
  misfit.rms = d->rms_train_before;
  for (const int row : outcome.off) {
    const std::vector<int>& original = distinct.original[static_cast<std::size_t>(row)];
    misfit.outlier_rows.insert(misfit.outlier_rows.end(), original.begin(), original.end());
  }
  std::sort(misfit.outlier_rows.begin(), misfit.outlier_rows.end());
  misfit.outliers = static_cast<int>(misfit.outlier_rows.size());
}

void AddMisreadRepeats(const Recording& recorded, const DistinctRows& distinct, Misfit* misfit) {
  std::vector<int>& rows = misfit->outlier_rows;
  for (const int row : MisreadRepeats(recorded, distinct)) {
    if (!std::binary_search(rows.begin(), rows.end(), row)) {
      rows.insert(std::upper_bound(rows.begin(), rows.end(), row), row);
    }
  }
  misfit->outliers = static_cast<int>(rows.size());
}

double DoubtedNoise(const LoopOutcome& outcome) {
  constexpr double kNoChance = 1e-9, kWorthSaying = 1.25;
  const double squares = outcome.fit.y().squaredNorm();
  const double dof =
      std::max(1.0,
               outcome.fit.rows->degrees_of_freedom() -
                   static_cast<double>(outcome.fit.free.size() + outcome.fit.X.cols()));
  const double times = std::sqrt(squares / dof);
  return times > kWorthSaying && ChiSquareTail(squares, dof) < kNoChance ? times : 0;
}

void AddNotesOnRows(const Loop& loop, const LoopOutcome& outcome, DiagnosisResult* d) {
  if (!outcome.slow.none()) {
    d->notes.push_back(fmt::format(
        "The readings' errors wander: {:.0f} % of their variance goes on from a reading to the "
        "next, to {:.0f} %. It was taken out as slow noise, so that it is not taken for a drift "
        "or a step.",
        100 * outcome.slow.share,
        100 * outcome.slow.persistence));
  }
  if (outcome.joint_noise > 0) {
    d->notes.push_back(fmt::format(
        "The readings scatter as if every joint stood {:.2g} mrad (one sigma) beside its recorded "
        "angle, each time anew: more where levers are longer. It was taken for noise of the "
        "joints.",
        1e3 * outcome.joint_noise));
  }
  const std::size_t good = loop.GoodReadings(false).size();
  if (good > static_cast<std::size_t>(kTuning.most_searched)) {
    d->notes.push_back(fmt::format(
        "{} of {} rows were searched, evenly over the recording; the last fit uses all.",
        loop.Choice().readings.size(),
        good));
  }
}

}  // namespace dhcal
