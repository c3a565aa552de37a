#include "problems/setup/own_position.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/setup/length_units.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr int kFewestRows = 8;
constexpr int kFewestDecimals = 1;  // of millimetres: coarser readings might agree by chance ...
constexpr int kMostDecimals = 4;    // ... and finer ones are a simulation, not a display
constexpr double kWithin = 1.5;     // times the rounding: of the RMS

}  // namespace

std::optional<SetupCause> OwnPosition(const Files& files, double misfit) {
  const Recording& recording = files.recording;
  if (recording.p_WQ.rows() < kFewestRows) return std::nullopt;
  const int decimals = DecimalsOf(recording.p_WQ.reshaped() / kMillimetre);
  if (decimals < kFewestDecimals || decimals > kMostDecimals) return std::nullopt;
  const double quantum = kMillimetre * std::pow(10.0, -decimals);
  // Three coordinates, each uniform within half a quantum; joints likewise, at the arm's length.
  const Eigen::VectorXd joints = ReadOutOf(recording, files.robot()).last_digit();
  const double rounding = std::sqrt(
      (3 * quantum * quantum + std::pow(ReachOf(files.robot()), 2) * joints.squaredNorm()) / 12);
  if (!(misfit <= kWithin * rounding)) return std::nullopt;
  SetupCause cause;
  cause.kind = "own_position";
  cause.sentence = fmt::format(
      "The readings are the nominal robot's own positions to their last digit (0.{:0>{}} mm; the "
      "nominal robot misses them by {:.2g} mm RMS): the controller computed them from the table, "
      "and nothing was measured.",
      1,
      decimals,
      misfit / kMillimetre);
  cause.where = HeaderWhere(files);
  cause.text = "record positions from an instrument beside the robot";
  cause.rms_before = cause.rms_after = misfit;
  return cause;
}

}  // namespace dhcal
