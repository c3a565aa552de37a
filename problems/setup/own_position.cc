#include "problems/setup/own_position.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/setup/frames_alone.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr int kFewestRows = 8;
constexpr int kFewestDecimals = 1;  // of millimetres: coarser readings might agree by chance ...
constexpr int kMostDecimals = 4;    // ... and finer ones are a simulation, not a display
constexpr double kWithin = 1.5;     // times the rounding: of the RMS

/// Decimals of millimetres that hold all numbers; more than kMostDecimals where none do.
int DecimalsOf(const Eigen::MatrixXd& lengths) {
  int decimals = 0;
  for (Eigen::Index k = 0; k < lengths.size(); ++k) {
    const double mm = lengths.data()[k] / kMillimetre;
    if (std::isnan(mm)) continue;
    while (decimals <= kMostDecimals) {
      const double scaled = mm * std::pow(10.0, decimals);
      if (std::abs(scaled - std::round(scaled)) < 1e-6 * std::max(1.0, std::abs(scaled) * 1e-6)) {
        break;
      }
      ++decimals;
    }
  }
  return decimals;
}

}  // namespace

std::optional<SetupCause> OwnPosition(const Files& files) {
  const Recording& recording = files.recording;
  if (recording.p_WQ.rows() < kFewestRows) return std::nullopt;
  const int decimals = DecimalsOf(recording.p_WQ);
  if (decimals < kFewestDecimals || decimals > kMostDecimals) return std::nullopt;
  const double quantum = kMillimetre * std::pow(10.0, -decimals);
  // Three coordinates, each uniform within half a quantum; joints likewise, at the arm's length.
  const Eigen::VectorXd joints = ReadOutQuanta(recording, files.robot());
  const double rounding = std::sqrt(
      (3 * quantum * quantum + std::pow(ReachOf(files.robot()), 2) * joints.squaredNorm()) / 12);
  const double rms = FitFrames(files.spec, recording).rms;
  if (!(rms <= kWithin * rounding)) return std::nullopt;
  SetupCause cause;
  cause.kind = "own_position";
  cause.sentence = fmt::format(
      "The readings are the nominal robot's own positions to their last digit (0.{:0>{}} mm; the "
      "nominal robot misses them by {:.2g} mm RMS): the controller computed them from the table, "
      "and nothing was measured.",
      1,
      decimals,
      rms / kMillimetre);
  cause.where = HeaderWhere(files);
  cause.text = "record positions from an instrument beside the robot";
  cause.rms_before = cause.rms_after = rms;
  return cause;
}

}  // namespace dhcal
