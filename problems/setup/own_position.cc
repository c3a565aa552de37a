#include "problems/setup/own_position.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "problems/calibration.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/prediction.h"
#include "problems/setup/frames_alone.h"
#include "problems/setup/length_units.h"
#include "problems/setup/words.h"
#include "problems/start.h"

namespace dhcal {
namespace {

constexpr int kFewestRows = 8;
constexpr int kFewestDecimals = 1;  // of millimetres: coarser readings might agree by chance ...
constexpr int kMostDecimals = 4;    // ... and finer ones are a simulation, not a display
constexpr double kWithin = 1.5;     // times the rounding: of the RMS
constexpr int kFewestLeft = 10;     // coordinates beyond those that the geometry takes
constexpr double kNoGeometry = 1e-3;

/// Probability under noise that the whole geometry comes as much nearer to the readings as it does;
/// 0 where they are too few to ask. A real robot's errors show themselves here however coarsely its
/// joint angles are written.
double ChanceOfGeometry(const Files& files) {
  const ProblemSpec spec = FramesOnly(files.spec, files.recording);
  Calibration frames(spec, files.recording);
  AlignStart(&frames);
  const std::optional<ResidualStatistics> before = FitFramesAlone(&frames, {});
  const auto complete = FitComplete(spec, files.recording, {}, {});
  if (!before || !complete->usable() || complete->fit.summary.trace.empty()) return 0;
  const ResidualStatistics after =
      Statistics(complete->calibration, complete->state(), complete->calibration.readings.fitted);
  const double count = before->num_lengths;
  const int rank = complete->fit.summary.trace.back().rank;
  const auto of_frames = static_cast<int>(frames.parameters.size());
  if (!(count >= rank + kFewestLeft)) return 0;
  const double squares = before->rms * before->rms * count;
  const double removed = squares - after.rms * after.rms * count;
  return RemovalTail(removed, std::max(rank - of_frames, 1), squares, count - of_frames);
}

}  // namespace

std::optional<SetupCause> OwnPosition(const Files& files, double misfit) {
  const Recording& recording = files.recording;
  if (recording.p_WQ.rows() < kFewestRows) return std::nullopt;
  const int decimals = DecimalsOf(recording.p_WQ.reshaped() / kMillimetre);
  if (decimals < kFewestDecimals || decimals > kMostDecimals) return std::nullopt;
  const double quantum = kMillimetre * std::pow(10.0, -decimals);
  // Three coordinates, each uniform within half a quantum; joints likewise, at the arm's length.
  const Eigen::VectorXd joints = ReadOutOf(recording, files.robot()).last_digit();
  const double of_joints = ReachOf(files.robot()) * joints.norm();
  const double rounding = std::sqrt((3 * quantum * quantum + of_joints * of_joints) / 12);
  if (!(misfit <= kWithin * rounding) || ChanceOfGeometry(files) < kNoGeometry) return std::nullopt;
  SetupCause cause;
  cause.kind = "own_position";
  const std::string digits =
      of_joints > quantum
          ? std::string("as exactly as the last digit of the joints' values lets them be")
          : fmt::format("to their last digit (0.{:0>{}} mm)", 1, decimals);
  cause.sentence = fmt::format(
      "The readings are the nominal robot's own positions {}: it misses them by {:.2g} mm RMS, and "
      "no correction of its geometry comes nearer. The controller computed them from the table; "
      "nothing was measured.",
      digits,
      misfit / kMillimetre);
  cause.where = HeaderWhere(files);
  cause.text = "record positions from an instrument beside the robot";
  cause.rms_before = cause.rms_after = misfit;
  return cause;
}

}  // namespace dhcal
