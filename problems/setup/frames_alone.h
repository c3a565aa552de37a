// The nominal robot of a problem with nothing but base and tool estimated: what every set-up is
// judged by.
#ifndef DHCAL_PROBLEMS_SETUP_FRAMES_ALONE_H_
#define DHCAL_PROBLEMS_SETUP_FRAMES_ALONE_H_

#include <optional>

#include <Eigen/Core>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "problems/frames.h"

namespace dhcal {

/// Of the reach: what the nominal robot of right files leaves at most, base and tool fitted.
constexpr double kNominalFits = 0.012;

/// The problem with base and tool free, no loss, no priors and only the effects that are held.
/// Where positions were measured the kind is that of positions, whatever the problem makes of them.
ProblemSpec FramesOnly(const ProblemSpec& spec, const Recording& recording);

struct FramesAlone {
  /// [m] 3-D where points are measured, else per coordinate; infinite where no fit was possible.
  double rms = 0;
  std::optional<Frames> frames;  // as fitted
  Eigen::Matrix3Xd points;       // [m] of every row as predicted; empty where no fit was possible
};

/// Fits base and tool of `spec` (FramesOnly is applied) to the recording's rows that are not set
/// aside, fitted and test rows alike.
FramesAlone FitFrames(const ProblemSpec& spec, const Recording& recording);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_FRAMES_ALONE_H_
