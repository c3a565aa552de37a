// When files cannot belong together: what is wrong in them, found by trying.
#ifndef DHCAL_PROBLEMS_SETUP_DOCTOR_H_
#define DHCAL_PROBLEMS_SETUP_DOCTOR_H_

#include <optional>
#include <vector>

#include "problems/setup/cause.h"
#include "problems/setup/frames_alone.h"

namespace dhcal {

struct Findings {
  std::vector<SetupCause> causes;   // best alternative first; empty where none is far better
  std::optional<CuredFiles> cured;  // of the first alternative, where there is only one
};

/// Tries every cause of the registry, alone and together, under which the nominal robot with base
/// and tool fitted meets the readings far better than as written. `rms_before` [m]: as written
/// (infinite where that could not be fitted). `most_causes`: alternatives with more are not
/// claimed. Seconds at most, whatever the number of rows.
Findings FindCauses(const Files& files, double rms_before, int most_weight);

/// Whether the frames of the runs differ: one more thing to try where all else is right.
Findings FindMovedFrames(const Files& files, double rms_before);

/// Orientations in another form than the columns say.
struct OrientationFindings {
  double misfit = 0;  // [rad] RMS, as written; 0 where there are none to judge
  Findings findings;  // empty where no other form fits
};
/// `frames_alone`: FitFrames of the files.
OrientationFindings FindOrientationForm(const Files& files, const FramesAlone& frames_alone);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_SETUP_DOCTOR_H_
