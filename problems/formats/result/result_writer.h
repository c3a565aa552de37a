// Writes a result folder: all of it or nothing (FORMATS.md, section 3).
#ifndef DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_WRITER_H_
#define DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_WRITER_H_

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/model/result.h"

namespace dhcal {

/// result.json, schema 1.
std::string ResultToJson(const Result& result);

/// residuals.csv.
std::string ResidualsToCsv(const Result& result, const Recording& recording);

/// A recording as CSV in the program's own input format, full precision.
std::string RecordingToCsv(const Recording& recording, const RobotModel& robot);

/// The problem's effects, those that were estimated held at what a fit of `recording` found. As the
/// problem has them where nothing but effects was estimated.
std::vector<EffectRequest> EffectsAsFound(const ProblemSpec& spec,
                                          const Recording& recording,
                                          const std::vector<ParameterResult>& parameters);

/// The problem file with the corrected values as its nominal ones, and its effects held where
/// `effects` are; `recording_path` is what its key `recording` will say (relative to where the text
/// will be stored).
std::string CalibratedYaml(const ProblemSpec& spec,
                           const RobotModel& calibrated,
                           const std::vector<EffectRequest>& effects,
                           const std::string& recording_path);

/// The same model as a Python module without dependencies: forward and inverse kinematics with
/// those effects that depend on the pose and its approach. What it cannot hold it names, and
/// refuses to compute without.
std::string CalibratedPython(const std::string& problem,
                             const RobotModel& calibrated,
                             const std::vector<EffectRequest>& effects);

/// The problem's URDF with the origins of its joints corrected: the robot without effects where
/// some were found, which a comment names, for a URDF cannot hold them. "" where the rows do not
/// come from a URDF, or, with a warning, where the calibrated ones are too far from it.
std::string CalibratedUrdf(const ProblemSpec& spec, const Result& result, Diagnostics* diagnostics);

/// Checks, before anything is computed, that `directory` can be written: it is absent, empty, or
/// holds only files of an earlier result. Otherwise adds an error.
void CheckResultDirectory(const std::string& directory, Diagnostics* diagnostics);

/// Writes the folder aside and renames it; an earlier result stays whole until the new one is.
/// The report is written in all its forms; a simulated recording is stored as recording.csv.
/// Returns false after adding an error.
bool WriteResult(const ProblemSpec& spec,
                 const Recording& recording,
                 const Result& result,
                 const std::string& directory,
                 Diagnostics* diagnostics);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_RESULT_RESULT_WRITER_H_
