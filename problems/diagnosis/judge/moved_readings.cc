#include "problems/diagnosis/judge/moved_readings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/moved_by_joint.h"

namespace dhcal {
namespace {

/// Squares [m^2, per coordinate of all fitted readings] by which the rows miss the model.
double SquaresOf(const JointModel& model,
                 const LoopOutcome& outcome,
                 const std::vector<int>& rows) {
  const Calibration& c = model.calibration();
  RowChoice choice = *outcome.fit.choice;
  choice.weights.weight.resize(0);
  choice.weights.slow = SlowNoise();
  choice.readings.clear();
  for (const std::vector<Reading>* const set : {&c.readings.fitted, &c.readings.test}) {
    for (const Reading& reading : *set) {
      if (std::find(rows.begin(), rows.end(), reading.row_idx) != rows.end()) {
        choice.readings.push_back(reading);
      }
    }
  }
  const double sigma = outcome.noise.sigma;
  const Eigen::VectorXd y = model.ResidualsAt(outcome.fit.state, choice);
  return sigma * sigma * y.squaredNorm() / static_cast<double>(outcome.fit.y().size());
}

std::string NoteOn(const PhysicsContext& c,
                   int joint,
                   const std::vector<int>& rows,
                   const DistinctRows& distinct) {
  const Eigen::VectorXd q = c.q(joint)(rows) / (c.revolute(joint) ? kDegree : kMillimetre);
  std::vector<int> numbers;
  for (const int row : rows) {
    for (const int own : distinct.original[static_cast<std::size_t>(row)]) {
      numbers.push_back(own + 1);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return fmt::format(
      "Rows {} were set aside, but are not misread: all of them lie off the way joint {} moves, "
      "and with it between {:.1f} and {:.1f} {} (misreadings look so in less than {:g} of "
      "recordings). A damaged tooth or a dent of a bearing does this. It is not modelled.",
      fmt::join(numbers, ", "),
      joint + 1,
      q.minCoeff(),
      q.maxCoeff(),
      c.revolute(joint) ? "deg" : "mm",
      kChanceOfAPlace);
}

}  // namespace

void AddMovedReadings(const JointModel& model,
                      const LoopOutcome& outcome,
                      const DistinctRows& distinct,
                      DiagnosisResult* d) {
  const PhysicsContext& c = *outcome.fit.context;
  std::map<int, std::vector<int>> of_joint;
  for (const auto& [row, joint] : outcome.moved) of_joint[joint].push_back(row);
  double largest = 0;
  int worst = -1;
  for (const auto& [joint, rows] : of_joint) {
    d->notes.push_back(NoteOn(c, joint, rows, distinct));
    const double squares = SquaresOf(model, outcome, rows);
    if (squares <= largest) continue;
    largest = squares;
    worst = joint;
  }
  d->misfit.p_value = std::min(d->misfit.p_value, kChanceOfAPlace);
  if (d->unexplained || worst < 0) return;
  const double variance = d->misfit.noise_sigma * d->misfit.noise_sigma;
  const auto above_noise = [&](double rms) { return std::max(rms * rms - variance, 0.0); };
  // Of what the geometry alone misses, these rows too.
  const double before = above_noise(d->rms_train_before), after = above_noise(d->rms_train_after);
  const double named = std::max(before - after, 0.0);
  Unexplained rest;
  rest.slot = c.slots().Name(c.joint_slot(worst));
  rest.driver = fmt::format("q{}", worst + 1);
  rest.unit = c.revolute(worst) ? Unit::kRadian : Unit::kMetre;
  rest.rms = std::sqrt(largest + after);
  rest.fraction = d->findings.empty() ? 1.0 : (largest + after) / (largest + after + named);
  d->unexplained = rest;
}

}  // namespace dhcal
