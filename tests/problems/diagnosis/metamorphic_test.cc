// A diagnosis must not depend on what has nothing to do with the robot: how runs are called, in
// which units, frame and order things are written, what else the file holds.
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/physics/registry.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/problem_cases.h"
#include "tests/support/robots.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_file.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

/// Effect and place; settings rounded, since orders are refined to the last digit. The end of a
/// soft zone is refined as well, over a wide range that noise moves it in.
std::string Label(const EffectRequest& request) {
  std::string label = fmt::format("{}.{}", request.effect, request.joint);
  for (const auto& [name, value] : request.settings) {
    label += name == "soft_torque_Nm" ? " soft" : fmt::format(" {} {:.0f}", name, value);
  }
  return label;
}

std::string Label(const HypothesisResult& hypothesis) {
  std::set<std::string> members;
  for (const EffectRequest& effect : hypothesis.effects) members.insert(Label(effect));
  std::string label;
  for (const std::string& member : members) label += (label.empty() ? "" : " + ") + member;
  return label.empty() ? "geometry" : label;
}

/// What a reader acts upon.
struct Decision {
  std::string verdict;
  std::set<std::string> kept;
  std::map<std::string, std::vector<FoundParameter>> findings;
};

Decision DecisionOf(const Draw& draw) {
  const DiagnosisResult d = Diagnosed(draw.spec, draw.recording);
  Decision decision;
  decision.verdict = ToString(d.verdict);
  for (const HypothesisResult& hypothesis : d.hypotheses) {
    if (hypothesis.kept) decision.kept.insert(Label(hypothesis));
  }
  for (const Finding& f : d.findings) decision.findings[Label(f.effect)] = f.parameters;
  return decision;
}

void ExpectSame(const Decision& a, const Decision& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.kept, b.kept);
  ASSERT_EQ(a.findings.size(), b.findings.size());
  for (const auto& [name, parameters] : a.findings) {
    const auto other = b.findings.find(name);
    ASSERT_NE(other, b.findings.end()) << name;
    ASSERT_EQ(parameters.size(), other->second.size()) << name;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const FoundParameter &x = parameters[k], &y = other->second[k];
      EXPECT_NEAR(x.value, y.value, 1e-3 * x.sigma) << x.name;
      EXPECT_NEAR(x.sigma, y.sigma, 1e-4 * x.sigma) << x.name;
    }
  }
}

/// Three runs over the rows of a draw.
Draw InRuns(Draw draw) {
  draw.recording.run_names = {"one", "two", "three"};
  const int n = draw.recording.num_rows();
  for (int row = 0; row < n; ++row) draw.recording.run_idx.push_back(3 * row / n);
  return draw;
}

Draw TwoEffects() {
  Scenario s;
  EffectRequest line;
  line.effect = "gear_harmonic";
  line.joint = 3;
  line.settings["order"] = 121;
  line.values["sin_121"] = 1e-4;
  s.truth = {Request("joint_compliance", 2, {{"compliance", 3e-6}}), line};
  return InRuns(MakeDraw(s, 31));
}

Draw Clean() { return InRuns(MakeDraw(Scenario(), 32)); }

std::vector<std::string> AllNames() {
  std::vector<std::string> names;
  for (const Effect* const effect : AllEffects()) names.push_back(effect->Describe().name);
  return names;
}

Draw WithNamesInOrder(Draw draw) {
  draw.spec.diagnosis.effects = AllNames();
  return draw;
}

Draw WithNamesReversed(Draw draw) {
  const std::vector<std::string> names = AllNames();
  draw.spec.diagnosis.effects.assign(names.rbegin(), names.rend());
  return draw;
}

Draw WithNamesTwice(Draw draw) {
  draw.spec.diagnosis.effects = AllNames();
  for (const std::string& name : AllNames()) draw.spec.diagnosis.effects.push_back(name);
  return draw;
}

Draw WithRunsRenamed(Draw draw) {
  draw.recording.run_names = {"zebra", "Monday", "0"};
  return draw;
}

Draw ReadInRadiansAndMetres(Draw draw) {
  const Recording& rec = draw.recording;
  std::string csv = "run,x_m,y_m,z_m";
  for (int j = 1; j <= rec.num_joints(); ++j) csv += fmt::format(",q{}_rad", j);
  for (int row = 0; row < rec.num_rows(); ++row) {
    csv += "\n" + rec.run_names[static_cast<std::size_t>(rec.run(row))];
    for (int k = 0; k < 3; ++k) csv += fmt::format(",{}", rec.p_WQ(row, k));
    for (int j = 0; j < rec.num_joints(); ++j) csv += fmt::format(",{}", rec.q(row, j));
  }
  const TempFile file(csv + "\n", ".csv");
  Diagnostics diagnostics;
  draw.recording = ReadRecording(file.path(), draw.spec.robot.joints, &diagnostics).value();
  return draw;
}

Draw ReadInDegreesAndMillimetres(Draw draw) {
  const Recording& rec = draw.recording;
  std::string csv;
  for (int j = 1; j <= rec.num_joints(); ++j) csv += fmt::format("q{}_deg,", j);
  csv += "x_mm,y_mm,z_mm,run";
  for (int row = 0; row < rec.num_rows(); ++row) {
    csv += "\n";
    for (int j = 0; j < rec.num_joints(); ++j) csv += fmt::format("{},", rec.q(row, j) / kDegree);
    for (int k = 0; k < 3; ++k) csv += fmt::format("{},", rec.p_WQ(row, k) / kMillimetre);
    csv += rec.run_names[static_cast<std::size_t>(rec.run(row))];
  }
  const TempFile file(csv + "\n", ".csv");
  Diagnostics diagnostics;
  draw.recording = ReadRecording(file.path(), draw.spec.robot.joints, &diagnostics).value();
  return draw;
}

Draw MeasuredFromElsewhere(Draw draw) {
  const Eigen::Isometry3d X_VW = MakeFrame({1.5, -2, 0.4}, {0.3, -0.8, 1.9});
  for (int row = 0; row < draw.recording.num_rows(); ++row) {
    const Eigen::Vector3d p_WQ = draw.recording.p_WQ.row(row);
    draw.recording.p_WQ.row(row) = X_VW * p_WQ;
  }
  return draw;
}

Draw WithAnotherColumn(Draw draw) {
  ExtraColumn column;
  column.name = "humidity";
  column.values.resize(draw.recording.num_rows());
  Rng rng(5);
  for (double& value : column.values) value = rng.Uniform(30, 60);
  draw.recording.extra.push_back(column);
  return draw;
}

struct Change {
  std::string name;
  std::function<Draw(Draw)> apply;
};

class Metamorphic : public testing::TestWithParam<Change> {};

TEST_P(Metamorphic, LeavesTwoEffectsAsTheyAre) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  static const Decision plain = DecisionOf(TwoEffects());
  ASSERT_EQ(plain.verdict, "explained");
  ASSERT_EQ(plain.findings.size(), 2);
  ExpectSame(plain, DecisionOf(GetParam().apply(TwoEffects())));
}

TEST_P(Metamorphic, LeavesACleanRecordingClean) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  static const Decision plain = DecisionOf(Clean());
  ASSERT_EQ(plain.verdict, "consistent");
  ExpectSame(plain, DecisionOf(GetParam().apply(Clean())));
}

INSTANTIATE_TEST_SUITE_P(Changes,
                         Metamorphic,
                         testing::Values(Change{"NamesInOrder", WithNamesInOrder},
                                         Change{"NamesReversed", WithNamesReversed},
                                         Change{"NamesTwice", WithNamesTwice},
                                         Change{"RunsRenamed", WithRunsRenamed},
                                         Change{"RadiansAndMetres", ReadInRadiansAndMetres},
                                         Change{"DegreesAndMillimetres",
                                                ReadInDegreesAndMillimetres},
                                         Change{"MeasuredFromElsewhere", MeasuredFromElsewhere},
                                         Change{"AnotherColumn", WithAnotherColumn}),
                         [](const auto& param) { return param.param.name; });

struct Weak {
  std::string name;
  EffectRequest effect;
  std::uint64_t seed;
};

class MoreNoise : public testing::TestWithParam<Weak> {};

// An effect that is plain at the lower noise and hardly seen, or not at all, at the highest.
TEST_P(MoreNoise, OnlyWidensTheConfidenceSet) {
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  Decision before;
  for (const double factor : {1.0, 2.0, 4.0}) {
    SCOPED_TRACE(factor);
    Scenario s;
    s.truth = {GetParam().effect};
    s.sigma *= factor;
    const Decision now = DecisionOf(MakeDraw(s, GetParam().seed));
    // With the geometry alone not rejected nothing is: the other hypotheses are not even tested.
    const bool all = now.kept.count("geometry") > 0;
    for (const std::string& kept : before.kept)
      EXPECT_TRUE(all || now.kept.count(kept) > 0) << kept;
    // Of several that remain, noise may put another first; none may be new.
    for (const auto& [name, parameters] : now.findings) {
      const bool known = before.findings.count(name) > 0 || before.kept.count(name) > 0;
      EXPECT_TRUE(factor == 1 || known) << name;
    }
    before = now;
  }
}

EffectRequest Small(const std::string& effect, int joint, const std::string& name, double value) {
  EffectRequest request;
  request.effect = effect;
  request.joint = joint;
  request.values[name] = value;
  return request;
}

INSTANTIATE_TEST_SUITE_P(
    Effects,
    MoreNoise,
    testing::Values(Weak{"Compliance2", Small("joint_compliance", 2, "compliance", 6e-7), 33},
                    Weak{"Compliance3", Small("joint_compliance", 3, "compliance", 1e-6), 34},
                    Weak{"Gain4", Small("joint_gain", 4, "gain", 2e-4), 35},
                    Weak{"Backlash4", Small("backlash", 4, "width", 3e-4), 36}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace dhcal
