// Builds the least-squares problem of a calibration.
#ifndef DHCAL_PROBLEMS_ASSEMBLY_H_
#define DHCAL_PROBLEMS_ASSEMBLY_H_

#include <memory>
#include <vector>

#include <ceres/loss_function.h>

#include "core/model/parameter.h"
#include "core/solver/estimation_problem.h"
#include "problems/calibration.h"
#include "residuals/reading_rows.h"
#include "residuals/row_cache.h"

namespace dhcal {

/// Tolerance (a prior's sigma where there is one) and limit of each unknown.
UnknownScales ScalesOf(const std::vector<Parameter>& parameters);

/// What whitens the rows of a calibration.
RowNoise RowNoiseOf(const Calibration& calibration, const Noise& noise);

/// The readings of a calibration as rows of its unknowns. What they depend on of the calibration
/// must outlive them.
ReadingRows RowsOf(const Calibration& calibration, const std::vector<Reading>& readings);

/// The fitted readings, whitened, and the priors, at the zero state.
class CalibrationProblem final : public EstimationProblem {
 public:
  /// `calibration` must outlive it. `with_loss`: apply the problem's robust loss.
  CalibrationProblem(const Calibration& calibration, const Noise& noise, bool with_loss = true);

  /// Other noise from here on.
  void Rewhiten(const Noise& noise);

  const ReadingRows& rows() const { return rows_; }
  const RowNoise& row_noise() const { return row_noise_; }
  const RowCache& cache() const { return cache_; }

 private:
  const Calibration& calibration_;
  ReadingRows rows_;
  RowNoise row_noise_;
  std::unique_ptr<ceres::LossFunction> loss_;
  RowCache cache_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_ASSEMBLY_H_
