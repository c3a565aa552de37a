#include "tools/transfer/transfer.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/diagnosis/unseen.h"
#include "problems/identify.h"
#include "problems/prediction.h"

namespace dhcal {
namespace {

constexpr double kVisited = 2 * kDegree;  // [rad] from an angle where the joint has been

/// Sums of squares of the points' errors.
struct Sum {
  double square = 0;  // [m^2]
  int rows = 0;
  double rms() const { return rows > 0 ? std::sqrt(square / rows) : kUnknown; }
};

Errors ErrorsOf(const Sum& before, const Sum& after) {
  return {before.rows, before.rms(), after.rms()};
}

/// Per fold, then over all: whitened residuals times sigma.
std::vector<Sum> SumsByFold(const CompleteFit& fit, const Folds& folds) {
  const LeftOutRows rows(fit, folds);
  const Eigen::VectorXd residuals = rows.Residuals({});
  const int coordinates = fit.calibration.spec.measurement.kind.num_coordinates();
  std::vector<Sum> sums(static_cast<std::size_t>(folds.count) + 1);
  for (Eigen::Index first = 0; first < residuals.size(); first += coordinates) {
    const int row = rows.recording_row()[static_cast<std::size_t>(first)];
    const double sigma = fit.calibration.RowSigma(row, fit.fit.noise_seen);
    const double square =
        sigma * sigma * residuals.segment(first, std::min(coordinates, 3)).squaredNorm();
    for (Sum* sum : {&sums[static_cast<std::size_t>(folds.of_row[static_cast<std::size_t>(row)])],
                     &sums.back()}) {
      sum->square += square;
      ++sum->rows;
    }
  }
  return sums;
}

double SquareOf(const CompleteFit& fit, const Reading& reading) {
  const Eigen::VectorXd residual = Compare(fit.calibration, fit.state(), reading).residual;
  return residual.head(std::min<Eigen::Index>(residual.size(), 3)).squaredNorm();
}

template <typename Predicate>
Errors ErrorsWhere(const CompleteFit& before,
                   const CompleteFit& after,
                   const std::vector<Reading>& readings,
                   Predicate predicate) {
  Sum of_before, of_after;
  for (const Reading& reading : readings) {
    if (!predicate(reading.row_idx)) continue;
    of_before.square += SquareOf(before, reading);
    of_after.square += SquareOf(after, reading);
    ++of_before.rows;
    ++of_after.rows;
  }
  return ErrorsOf(of_before, of_after);
}

/// True where every joint of a row has been near that angle in the other recording.
class Visits {
 public:
  explicit Visits(const Recording& recording) {
    for (int joint = 0; joint < recording.num_joints(); ++joint) {
      std::vector<double> angles;
      for (int row = 0; row < recording.num_rows(); ++row) {
        angles.push_back(recording.q(row, joint));
      }
      std::sort(angles.begin(), angles.end());
      angles_.push_back(angles);
    }
  }
  bool Inside(const Recording& recording, int row) const {
    for (std::size_t joint = 0; joint < angles_.size(); ++joint) {
      const double q = recording.q(row, static_cast<Eigen::Index>(joint));
      if (q < angles_[joint].front() || q > angles_[joint].back()) return false;
    }
    return true;
  }
  bool Visited(const Recording& recording, int row) const {
    for (std::size_t joint = 0; joint < angles_.size(); ++joint) {
      const double q = recording.q(row, static_cast<Eigen::Index>(joint));
      const auto next =
          std::lower_bound(angles_[joint].begin(), angles_[joint].end(), q - kVisited);
      if (next == angles_[joint].end() || *next > q + kVisited) return false;
    }
    return true;
  }

 private:
  std::vector<std::vector<double>> angles_;  // of each joint, ascending
};

}  // namespace

std::vector<int> ConsecutiveBlocks(int num_rows, int count) {
  std::vector<int> fold;
  for (int row = 0; row < num_rows; ++row) {
    fold.push_back(static_cast<int>(static_cast<long>(row) * count / num_rows));
  }
  return fold;
}

std::vector<Errors> PredictBlocks(const ProblemSpec& spec,
                                  const Recording& recording,
                                  const std::vector<EffectRequest>& effects,
                                  int count,
                                  const Progress& progress) {
  Folds folds;
  folds.of_row = ConsecutiveBlocks(recording.num_rows(), count);
  folds.count = count;
  const auto before = FitComplete(spec, recording, {}, progress);
  const auto after = FitComplete(spec, recording, effects, progress);
  std::vector<Errors> errors;
  if (!before->usable() || !after->usable()) return errors;
  const std::vector<Sum> of_before = SumsByFold(*before, folds);
  const std::vector<Sum> of_after = SumsByFold(*after, folds);
  for (std::size_t k = 0; k < of_before.size(); ++k) {
    errors.push_back(ErrorsOf(of_before[k], of_after[k]));
  }
  return errors;
}

UnseenBlock DiagnoseWithoutBlock(const ProblemSpec& spec,
                                 const Recording& recording,
                                 int block,
                                 int count,
                                 const Progress& progress) {
  Recording split = recording;
  const std::vector<int> fold = ConsecutiveBlocks(recording.num_rows(), count);
  split.is_test.assign(fold.size(), false);
  for (std::size_t row = 0; row < fold.size(); ++row) split.is_test[row] = fold[row] == block;
  const Result identified = IdentifyGeometry(spec, split, progress);
  UnseenBlock unseen;
  unseen.model = Diagnose(spec, split, identified, progress).model;
  const auto before = FitComplete(spec, split, {}, progress);
  const auto after = FitComplete(spec, split, unseen.model, progress);
  if (!before->usable() || !after->usable()) return unseen;
  unseen.errors = ErrorsWhere(
      *before, *after, before->calibration.readings.test, [](int /*row*/) { return true; });
  return unseen;
}

Transfer TransferTo(const ProblemSpec& spec,
                    const Recording& recording,
                    const Recording& first,
                    const std::vector<EffectRequest>& model,
                    const Progress& progress) {
  Transfer transfer;
  const auto before = FitComplete(spec, recording, {}, progress);
  const PhysicsContext context = before->calibration.Context();
  std::vector<EffectRequest> held;
  for (const EffectRequest& effect : model) {
    const Effect& entry = *FindEffect(effect.effect);
    // Instants and drifts belong to the days of the first recording.
    const bool passes = entry.Place(context, effect).driver == "time";
    if (passes || !entry.NotTestable(context, effect).empty()) {
      transfer.left_behind.push_back(InstanceName(effect));
      continue;
    }
    held.push_back(effect);
    held.back().held = true;
  }
  const auto after = FitComplete(spec, recording, held, progress);
  if (!before->usable() || !after->usable()) return transfer;
  const Visits visits(first);
  const std::vector<Reading>& readings = before->calibration.readings.fitted;
  const auto where = [&](auto predicate) {
    return ErrorsWhere(*before, *after, readings, predicate);
  };
  transfer.all = where([](int /*row*/) { return true; });
  transfer.inside = where([&](int row) { return visits.Inside(recording, row); });
  transfer.outside = where([&](int row) { return !visits.Inside(recording, row); });
  transfer.visited = where([&](int row) { return visits.Visited(recording, row); });
  return transfer;
}

}  // namespace dhcal
