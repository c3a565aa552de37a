#include "problems/recording_of.h"

#include "problems/formats/problem/problem_checks.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/identify.h"
#include "problems/simulate.h"

namespace dhcal {

std::optional<Recording> RecordingOf(const ProblemSpec& spec, Diagnostics* diagnostics) {
  if (!CheckRecordingExists(spec, diagnostics)) return std::nullopt;
  std::optional<Recording> recording =
      spec.simulate ? SimulateRecording(spec, diagnostics)
                    : ReadRecording(spec.recording, spec.robot.joints, spec.columns, diagnostics);
  if (!recording) return std::nullopt;
  CheckRecordingFits(spec, *recording, diagnostics);
  if (!diagnostics->ok()) return std::nullopt;
  CheckEnoughReadings(spec, *recording, diagnostics);
  return recording;
}

}  // namespace dhcal
