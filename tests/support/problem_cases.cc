#include "tests/support/problem_cases.h"

#include <cstdlib>

#include <glog/logging.h>
#include <gtest/gtest.h>

#include "problems/diagnosis/diagnose.h"
#include "problems/diagnosis/judge/invariants.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tests/support/files.h"

namespace dhcal {
namespace {

std::string FolderFrom(const char* variable) {
  const char* const folder = std::getenv(variable);
  return folder == nullptr ? "" : folder;
}

}  // namespace

std::string SourcePath(const std::string& relative) {
  return std::string(DHCAL_SOURCE_DIR) + "/" + relative;
}

std::string DataDir() { return FolderFrom("DHCAL_DATA"); }

std::string SharedDir() { return FolderFrom("DHCAL_SHARED"); }

ProblemSpec LoadCase(const std::string& name) {
  return LoadProblem(SourcePath("problems/cases/" + name + ".yaml"));
}

ProblemSpec LoadProblem(const std::string& file) {
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(file, DataDir(), &diagnostics);
  CHECK(spec.has_value()) << diagnostics.ToString();
  return *spec;
}

Recording RecordingOf(const ProblemSpec& spec) {
  Diagnostics diagnostics;
  const auto recording =
      spec.simulate ? SimulateRecording(spec, &diagnostics)
                    : ReadRecording(spec.recording, spec.robot.joints, spec.columns, &diagnostics);
  CHECK(recording.has_value()) << diagnostics.ToString();
  return *recording;
}

Result RunCase(const ProblemSpec& spec) {
  return IdentifyGeometry(spec, RecordingOf(spec), Progress());
}

DiagnosisResult Diagnosed(const ProblemSpec& spec, const Recording& recording) {
  const DiagnosisResult d = Diagnose(spec, recording, IdentifyGeometry(spec, recording, {}), {});
  // No report that any test makes may contradict itself.
  for (const std::string& wrong : Contradictions(d)) ADD_FAILURE() << wrong;
  return d;
}

std::map<std::string, ParameterResult> ByName(const FitResult& fit) {
  std::map<std::string, ParameterResult> by_name;
  for (const ParameterResult& parameter : fit.parameters) by_name[parameter.name] = parameter;
  return by_name;
}

}  // namespace dhcal
