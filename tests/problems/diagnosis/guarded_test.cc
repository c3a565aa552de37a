// No fault of a diagnosis loses the calibration that was made before it.
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/report.h"
#include "core/report/text_renderer.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/identify.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

TEST(Guarded, AFaultOfTheDiagnosisIsAnAnswerThatSaysWhy) {
  const DiagnosisResult d =
      Guarded([]() -> DiagnosisResult { throw std::runtime_error("no Cholesky factor"); });
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kFailed);
  EXPECT_THAT(d.summary, HasSubstr("no Cholesky factor"));
  EXPECT_EQ(Guarded([]() -> DiagnosisResult { throw 3; }).verdict, DiagnosisVerdict::kFailed);
  EXPECT_EQ(Guarded([] { return DiagnosisResult(); }).verdict, DiagnosisVerdict::kConsistent);
}

TEST(Guarded, TheReportHoldsTheCalibrationAndSaysThatTheDiagnosisFailed) {
  const Draw draw = MakeDraw(Scenario(), 1);
  Result result = IdentifyGeometry(draw.spec, draw.recording, {});
  result.diagnosis =
      Guarded([]() -> DiagnosisResult { throw std::runtime_error("F is infinite"); });
  const std::string report = ToText(ReportOf(draw.spec, draw.recording, result));
  EXPECT_THAT(report, HasSubstr("UNMODELLED EFFECTS: FAILED"));
  EXPECT_THAT(report, HasSubstr("F is infinite"));
  EXPECT_THAT(report, HasSubstr("theta1"));
}

}  // namespace
}  // namespace dhcal
