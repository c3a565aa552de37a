// Recordings made by another author's simulation, each with a text that says what is right: whole
// runs are judged by that text.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/diagnosis/calibrate.h"
#include "problems/diagnosis/judge/invariants.h"
#include "tests/support/files.h"
#include "tests/support/problem_cases.h"
#include "tests/support/sanitized.h"

namespace dhcal {
namespace {

constexpr int kAnyJoint = -1;
constexpr double kSameFit = 1.05;        // times: delivered and diagnosed model
constexpr double kRightInSigmas = 1.25;  // RMS over the identified parameters

struct SharedName {
  std::string effect;
  int joint = 0;
  double truth = 0;          // [SI] of one parameter, length of several; 0 = not told
  double share = 0;          // of it that is allowed; 0 = three sigma or 5 %
  std::string setting = {};  // that must have the value `at`; empty = any settings
  double at = 0;
};

/// What the text of a case says under "Right".
struct SharedRight {
  std::string name;
  std::set<DiagnosisVerdict> verdicts = {};   // empty = any answer
  std::vector<SharedName> names = {};         // found, or an alternative of what is found
  std::vector<SharedName> may = {};           // found or not
  std::vector<SharedName> never = {};         // not found
  bool alone = false;                         // nothing but `names` and `may` is found
  std::optional<std::vector<int>> rows = {};  // from 1: these are set aside, and no others
  std::string says = {};                      // in a note or the sentence of a finding
  std::string first = {};                     // effect of the first finding
  double unseen = 0;                          // unseen error, at most times the noise; 0 = any
  bool values = false;                        // the geometry put in is found
  bool parked = false;                        // joints 3 to 7 stand still and drive nothing
  std::string short_of = {};                  // why the verdict is not reached yet

  SharedRight& Is(std::set<DiagnosisVerdict> v) { return verdicts = std::move(v), *this; }
  SharedRight& Names(std::vector<SharedName> n) { return names = std::move(n), *this; }
  SharedRight& OnlyNames(std::vector<SharedName> n) { return alone = true, Names(std::move(n)); }
  SharedRight& AtMost(std::vector<SharedName> n) { return alone = true, may = std::move(n), *this; }
  SharedRight& Never(std::vector<SharedName> n) { return never = std::move(n), *this; }
  SharedRight& SetsAside(std::vector<int> r) { return rows = std::move(r), *this; }
  SharedRight& Says(std::string text) { return says = std::move(text), *this; }
  SharedRight& First(std::string effect) { return first = std::move(effect), *this; }
  SharedRight& Unseen(double times) { return unseen = times, *this; }
  SharedRight& Values() { return values = true, *this; }
  SharedRight& ShortOf(std::string why) { return short_of = std::move(why), *this; }
  SharedRight& Parked() { return parked = true, *this; }
};

void PrintTo(const SharedRight& right, std::ostream* out) { *out << right.name; }

SharedRight RightOf(const std::string& name) {
  SharedRight right;
  right.name = name;
  return right;
}

constexpr DiagnosisVerdict kNothing = DiagnosisVerdict::kConsistent;
constexpr DiagnosisVerdict kByNames = DiagnosisVerdict::kExplained;
constexpr DiagnosisVerdict kPartByNames = DiagnosisVerdict::kPartlyExplained;
constexpr DiagnosisVerdict kSeveralNames = DiagnosisVerdict::kAmbiguous;
constexpr DiagnosisVerdict kNoName = DiagnosisVerdict::kUnexplained;

std::vector<SharedRight> SharedRights() {
  // Only joints 1 and 2 of a straight arm move: other names stand beside joint 2's compliance.
  const auto straight_arm = [](double share) -> std::vector<SharedName> {
    return {{"joint_compliance", 2, 70e-6, share}};
  };
  const auto three_compliances = [](double share) -> std::vector<SharedName> {
    return {{"joint_compliance", 2, 62e-6, share},
            {"joint_compliance", 3, 68e-6, share},
            {"joint_compliance", 4, 55e-6, share}};
  };
  const std::vector<SharedName> two_slips = {{"tool_step", 0, 3.3e-3, 0, "at_row", 20},
                                             {"tool_step", 0, 4.8e-3, 0, "at_row", 60}};
  return {
      RightOf("coupling_4_by_3")
          .Is({kByNames, kSeveralNames})
          .OnlyNames({{"joint_coupling", 4, 0.22e-3, 0, "driver_joint", 3}}),
      RightOf("drift_of_the_base").Is({kByNames}).OnlyNames({{"base_drift", 0, 0.15e-3}}),
      RightOf("angles_rounded").Is({kNothing}).Says("rounding alone").Values(),
      RightOf("wire_with_length_offset").Is({kByNames}).OnlyNames({{"length_offset", 0, 15e-3}}),
      RightOf("gantry_scale").Is({kByNames}).OnlyNames({{"joint_gain", 1, 1e-3}}).Says("mm per m"),
      RightOf("not_settled")
          .Is({kByNames, kNoName})
          .OnlyNames({{"settling", 0, 0.5e-3}})
          .Never({{"backlash", kAnyJoint}}),
      RightOf("one_compliance_clean").Is({kSeveralNames}).Names(straight_arm(0)),
      RightOf("one_compliance_and_a_rest")
          .Is({kSeveralNames, kPartByNames})
          .Names(straight_arm(0.1)),
      RightOf("one_gross_row").Is({kNothing}).SetsAside({8}).Values(),
      RightOf("parked_joints_three_payloads")
          .Names({{"tool_per_run"}, {"joint_compliance", 2, 70e-6}})
          .Parked(),
      RightOf("play_and_outliers")
          .Is({kByNames})
          .OnlyNames({{"backlash", 4, 0.35e-3}})
          .SetsAside({65, 66, 93, 215, 242, 252, 309})  // 93 and 309 are test rows
          .Unseen(1.2),
      RightOf("repeats_and_targets")
          .Is({kPartByNames, kSeveralNames, kNoName})
          .AtMost({{"joint_compliance", 2}, {"joint_compliance", 3}})
          .Never({{"gear_harmonic", kAnyJoint}})
          .ShortOf("24 draws of unknown noise do not show the error of joints 4 and 5 as a rest"),
      RightOf("repeats_block").Is({kNothing}).Values(),
      RightOf("repeats_targets").Is({kNothing}).Values(),
      RightOf("scara_screw_spline")
          .Is({kByNames})
          .OnlyNames({{"joint_coupling", 3, 2.546e-3, 0, "driver_joint", 4}})
          .Says("mm per rad"),
      RightOf("sigma_overstated").Is({kNothing}).Says("times smaller than the stated noise"),
      RightOf("station_moved_runs")
          .Is({kByNames})
          .OnlyNames({{"base_per_run"}})
          .Says("base: {per_run: true}")
          .Unseen(1.2)
          .Values(),
      RightOf("strong_sag")
          .Is({kByNames})
          .OnlyNames({{"joint_compliance", 2, 50e-6}})
          .SetsAside({}),
      RightOf("test_rows_are_copies").Is({kNothing}).Says("prove"),
      RightOf("three_compliances_and_a_rest")
          .Is({kPartByNames, kSeveralNames})
          .Names(three_compliances(0.1))
          .Never({{"gravity_balancer", kAnyJoint}, {"link_bending", kAnyJoint}}),
      RightOf("three_compliances_clean").Is({kByNames}).OnlyNames(three_compliances(0)),
      RightOf("tool_moved_between_runs")
          .Is({kByNames, kSeveralNames})
          .OnlyNames({{"tool_per_run"}, {"joint_compliance", 2, 70e-6}})
          .First("tool_per_run")
          .Says("tool: {per_run: true}")
          .Parked(),
      RightOf("two_sags_and_a_drift")
          .Is({kByNames})
          .OnlyNames({{"joint_compliance", 2, 1.3e-6},
                      {"joint_compliance", 3, 1.7e-6},
                      {"base_drift", 0, 0.16e-3}}),
      RightOf("two_tool_slips").Is({kByNames}).OnlyNames(two_slips),
      // The text counts its misread row 40 from 0.
      RightOf("two_tool_slips_and_a_bad_row")
          .Is({kByNames})
          .OnlyNames(two_slips)
          .SetsAside({41})
          .Unseen(1.2),
      RightOf("wrapped_backlash").Names({{"backlash", 4, 1.2e-3}}),
      RightOf("zero_rows").Is({kNothing}).SetsAside({8, 34, 52}).Values(),
      RightOf("first_row_direction").Is({kByNames}).OnlyNames({{"backlash", 4, 1.2e-3}}),
  };
}

bool IsNamed(const EffectRequest& effect, const SharedName& name) {
  return effect.effect == name.effect && (name.joint == kAnyJoint || effect.joint == name.joint) &&
         (name.setting.empty() || effect.setting(name.setting, -1) == name.at);
}

bool IsAmong(const EffectRequest& effect, const std::vector<SharedName>& names) {
  return std::any_of(
      names.begin(), names.end(), [&](const SharedName& name) { return IsNamed(effect, name); });
}

void ExpectSize(const Finding& finding, const SharedName& name) {
  if (name.truth == 0 || finding.parameters.empty()) return;
  double squares = 0, variance = 0;
  for (const FoundParameter& p : finding.parameters) {
    squares += p.value * p.value;
    variance += p.sigma * p.sigma;
  }
  const bool one = finding.parameters.size() == 1;
  const double found = one ? finding.parameters[0].value : std::sqrt(squares);
  const double allowed = name.share > 0 ? name.share * name.truth
                                        : std::max(3 * std::sqrt(variance), 0.05 * name.truth);
  EXPECT_NEAR(found, name.truth, allowed) << finding.sentence;
}

void ExpectNamed(const DiagnosisResult& d, const SharedName& name) {
  bool listed = false;
  for (const Finding& finding : d.findings) {
    if (IsNamed(finding.effect, name)) {
      listed = true;
      ExpectSize(finding, name);
    }
    for (const Confusable& other : finding.confusable_with) {
      listed = listed || IsNamed(other.effect, name);
    }
  }
  EXPECT_TRUE(listed) << "not named: " << name.effect << " " << name.joint;
}

/// The corrections that the text lists, "theta [mrad]: 0.1 0.2; a [mm]: 0.3", by parameter.
std::map<std::string, double> PutIn(const std::string& file) {
  std::map<std::string, double> corrections;
  std::ifstream words(file);
  std::string word, name;
  while (words >> word && word != "corrections):") continue;
  int joint = 0;
  while (words >> word) {
    if (word[0] == '[') continue;
    if (word[0] >= 'a' && word[0] <= 'z') {
      name = word;
      joint = 0;
    } else {
      corrections[name + std::to_string(++joint)] = 1e-3 * std::stod(word);
    }
  }
  return corrections;
}

void ExpectGeometry(const FitResult& fit, const std::map<std::string, double>& truth) {
  double squares = 0;
  int compared = 0;
  for (const ParameterResult& p : fit.parameters) {
    if (p.verdict != Verdict::kIdentified || truth.count(p.name) == 0) continue;
    squares += std::pow((p.correction - truth.at(p.name)) / p.sigma, 2);
    ++compared;
  }
  ASSERT_GT(compared, 0);
  EXPECT_LT(std::sqrt(squares / compared), kRightInSigmas) << "sigmas, identified parameters";
}

bool IsSaid(const Result& result, const std::string& text) {
  std::string all;
  for (const std::string& note : result.notes) all += note + "\n";
  for (const Finding& finding : result.diagnosis->findings) all += finding.sentence + "\n";
  return all.find(text) != std::string::npos;
}

class RecordedCases : public testing::TestWithParam<SharedRight> {};

TEST_P(RecordedCases, AreJudgedAsTheirTextSays) {
  if (SharedDir().empty()) {
    GTEST_SKIP() << "set DHCAL_SHARED to the folder that holds cases/ to run this test";
  }
  if (kSanitized) GTEST_SKIP() << "too slow with sanitizers; the other tests run the same code";
  const SharedRight& right = GetParam();
  const std::string folder = SharedDir() + "/cases/" + right.name;
  const ProblemSpec spec = LoadProblem(folder + "/problem.yaml");
  const Result result = Calibrate(spec, RecordingOf(spec), {});
  ASSERT_TRUE(result.diagnosis.has_value());
  const DiagnosisResult& d = *result.diagnosis;
  SCOPED_TRACE(d.summary);
  ASSERT_NE(d.verdict, DiagnosisVerdict::kFailed);
  EXPECT_THAT(Contradictions(d), testing::IsEmpty());
  const bool verdict_right = right.verdicts.empty() || right.verdicts.count(d.verdict) > 0;
  EXPECT_EQ(verdict_right, right.short_of.empty()) << ToString(d.verdict) << " " << right.short_of;
  if (d.verdict != kNoName) {
    for (const SharedName& name : right.names) ExpectNamed(d, name);
  }
  for (const Finding& f : d.findings) {
    EXPECT_FALSE(IsAmong(f.effect, right.never)) << f.sentence;
    EXPECT_TRUE(!right.alone || IsAmong(f.effect, right.names) || IsAmong(f.effect, right.may))
        << f.sentence;
  }
  const std::string first = d.findings.empty() ? "nothing" : d.findings[0].effect.effect;
  EXPECT_TRUE(right.first.empty() || right.first == first) << "first: " << first;
  std::vector<int> rows;
  for (const RowSetAside& row : result.rows_set_aside) rows.push_back(row.row_idx + 1);
  EXPECT_EQ(rows, right.rows.value_or(rows));
  EXPECT_TRUE(IsSaid(result, right.says)) << "not said: " << right.says;
  if (right.unseen > 0) {
    EXPECT_LT(d.rms_test_after, right.unseen * spec.measurement.sigma.value());
  }
  if (result.delivered && !d.averaged) {
    EXPECT_LE(result.delivered->fit.rms, kSameFit * d.rms_train_after);
  }
  ASSERT_NE(result.delivered_fit(), nullptr);
  if (right.values) ExpectGeometry(*result.delivered_fit(), PutIn(folder + "/expect.txt"));
  const std::set<std::string> parked = {"q3", "q4", "q5", "q6", "q7"};
  for (const MapEntry& entry : d.map) {
    EXPECT_TRUE(!right.parked || parked.count(entry.driver) == 0) << entry.slot;
  }
}

INSTANTIATE_TEST_SUITE_P(Texts,
                         RecordedCases,
                         testing::ValuesIn(SharedRights()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace dhcal
