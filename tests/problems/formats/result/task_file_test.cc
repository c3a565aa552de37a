// A result folder that can be run again where the task's poses are those of a file.
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

TEST(ResultFolder, CalibratedYamlFindsTheFileOfTheTask) {
  const TempFolder folder;
  WriteFile(folder / "where.csv", "q1_deg,q2_deg,q3_deg\n90,0,5\n0,-45,6\n10,20,7\n");
  WriteFile(folder / "p.yaml",
            "schema: 1\nname: p\n"
            "robot: {joints: [{a_m: 0.3, alpha_deg: 90}, {a_m: 0.4}, {a_m: 0.2}]}\n"
            "measurement: {kind: position, sigma_mm: 0.05}\n"
            "parameters: {estimate: [theta, a]}\n"
            "task: {poses: where.csv}\n"
            "simulate: {motion: {kind: random, poses: 20}, errors: {a_m: [1e-3, 0, 0]}}\n");
  Diagnostics diagnostics;
  const auto spec = ReadProblemFile(folder / "p.yaml", "", &diagnostics);
  ASSERT_TRUE(spec.has_value()) << diagnostics.ToString();
  const auto recording = SimulateRecording(*spec, &diagnostics);
  ASSERT_TRUE(recording.has_value()) << diagnostics.ToString();
  const Result result = IdentifyGeometry(*spec, *recording, {});
  ASSERT_NE(result.best(), nullptr);
  ASSERT_TRUE(result.task.has_value());
  // One radius is a millimetre longer, the same at all poses.
  EXPECT_NEAR(result.task->before.rms, 1e-3, 1e-6);
  const std::string out = folder / "out/deep";
  std::filesystem::create_directory(folder / "out");
  ASSERT_TRUE(WriteResult(*spec, *recording, result, out, &diagnostics)) << diagnostics.ToString();
  const auto again = ReadProblemFile(out + "/calibrated.yaml", "", &diagnostics);
  ASSERT_TRUE(again && again->task) << diagnostics.ToString();
  EXPECT_EQ(again->task->q, spec->task->q);
}

}  // namespace
}  // namespace dhcal
