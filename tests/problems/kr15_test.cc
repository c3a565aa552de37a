// The paper's experiment: English et al. (2004), Table III, and what its figures leave open.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/fit_analysis.h"
#include "problems/noise.h"
#include "problems/simulate.h"
#include "tests/support/problem_cases.h"

namespace dhcal {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

/// Table III, "Identified", in 1e-6 rad and 1e-6 m.
const std::map<std::string, int> kTable3 = {
    {"theta1", 870}, {"theta2", 940},  {"theta3", -1000}, {"theta4", 620},  {"theta5", -807},
    {"theta6", 0},   {"alpha1", 157},  {"alpha2", 130},   {"alpha3", -160}, {"alpha4", -253},
    {"alpha5", 464}, {"alpha6", -320}, {"a1", 31},        {"a2", 51},       {"a3", 12},
    {"a4", -45},     {"a5", 63},       {"a6", 58},        {"d1", -75},      {"d2", -69},
    {"d3", 122},     {"d4", 48},       {"d5", -19},       {"d6", 78}};

ProblemSpec RunOn(ProblemSpec spec) {
  spec.solver.kappa = 0;
  return spec;
}

/// How far a fit is from the errors put in, along the directions of the parameters that the
/// readings determine, strongest first, in units of the tolerances (1e-3 rad or m: 1e-9 stands for
/// 1e-12).
Eigen::VectorXd DeviationAlongDirections(const ProblemSpec& spec, SolverMethod method) {
  const Recording recording = RecordingOf(spec);
  const Calibration c(spec, recording);
  FitSettings settings = SettingsOf(c);
  settings.method = method;
  const Fit fit = RunFit(c, settings);
  const FitAnalysis analysis = Analyse(c, fit).value();
  const Eigen::VectorXd truth = ErrorSlots(spec.robot, *spec.simulate);
  Eigen::VectorXd deviation = fit.summary.state;
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    deviation[static_cast<Eigen::Index>(k)] -= truth[c.parameters[k].slot];
  }
  const TruncatedSvd& svd = analysis.identifiability.readings;
  return svd.V.transpose() * deviation.cwiseQuotient(svd.scale);
}

void ExpectExactWhereDetermined(const Eigen::VectorXd& deviation, double strong) {
  ASSERT_EQ(deviation.size(), 24);
  EXPECT_LT(deviation.head(20).cwiseAbs().maxCoeff(), strong);
  // The next two have singular values of 2e-5 and 9e-6: rounding of readings near 1 m, 1e-16 m,
  // divided by those is 1e-11. The last two are d2 - d3 and theta6.
  EXPECT_LT(deviation.segment(20, 2).cwiseAbs().maxCoeff(), 2e-7);
}

TEST(Kr15, ReproducesTableThreeToThePrintedDigit) {
  const Result result = RunCase(LoadCase("kr15"));
  ASSERT_NE(result.best(), nullptr);
  const auto parameters = ByName(*result.best());
  for (const auto& [name, printed] : kTable3) {
    EXPECT_EQ(std::lround(parameters.at(name).correction * 1e6), printed) << name;
  }
}

TEST(Kr15, ReproducesThePapersIterationsRankAndKappaNorm) {
  const Result result = RunCase(LoadCase("kr15"));
  const FitResult& fit = *result.best();
  EXPECT_EQ(fit.termination, Termination::kKappa);
  EXPECT_EQ(fit.iterations, 2);
  EXPECT_EQ(fit.rank, 23);
  EXPECT_EQ(fit.columns, 24);
  EXPECT_GT(fit.kappa_norm, 3.0e-13);  // the paper prints 3.5697e-13
  EXPECT_LT(fit.kappa_norm, 4.1e-13);
  EXPECT_EQ(fit.trace.front().rank, 20);
  ASSERT_EQ(fit.singular_values.size(), 24u);
  EXPECT_NEAR(fit.singular_values[20], 2.0e-5, 0.1e-5);
  EXPECT_NEAR(fit.singular_values[21], 8.9e-6, 0.1e-6);
  EXPECT_NEAR(fit.singular_values[22], 3.8e-9, 0.1e-9);
  EXPECT_LT(fit.singular_values[23], fit.truncation_cut);
}

TEST(Kr15, RunOnEveryDeterminedDirectionIsExact) {
  ProblemSpec spec = RunOn(LoadCase("kr15"));
  // The path along which theta6 is hidden is curved: 2.6e-4 rad along it leave the straight null
  // direction by 6e-12.
  ExpectExactWhereDetermined(DeviationAlongDirections(spec, SolverMethod::kSvdGaussNewton), 1e-8);
  spec.simulate->row_errors(JointSlot::kTheta)[5] = 0;
  ExpectExactWhereDetermined(DeviationAlongDirections(spec, SolverMethod::kSvdGaussNewton), 1e-9);
}

TEST(Kr15, FindsByItselfWhatTheReadingsCannotTell) {
  const Result result = RunCase(RunOn(LoadCase("kr15")));
  const auto parameters = ByName(*result.best());
  EXPECT_EQ(parameters.at("theta6").verdict, Verdict::kUnobservable);
  EXPECT_THAT(parameters.at("theta6").explanation,
              HasSubstr("turns about an axis through the measured point"));
  EXPECT_EQ(parameters.at("d2").verdict, Verdict::kConfounded);
  EXPECT_THAT(parameters.at("d2").confounded_with, ElementsAre("d3"));
  EXPECT_THAT(result.best()->null_space,
              Contains(Field(&NullDirection::explanation,
                             "only d2 + d3 is determined: axes 2 and 3 are parallel")));
}

TEST(Kr15, LevenbergMarquardtAgreesOutsideTheNullSpace) {
  ProblemSpec spec = RunOn(LoadCase("kr15"));
  spec.solver.method = SolverMethod::kBoth;
  const Result result = RunCase(spec);
  ASSERT_EQ(result.comparison.size(), 24u);
  for (const ComparedParameter& compared : result.comparison) {
    EXPECT_LT(std::abs(compared.difference), 1e-9) << compared.name;
  }
  ExpectExactWhereDetermined(DeviationAlongDirections(spec, SolverMethod::kLevenbergMarquardt),
                             1e-6);
}

TEST(Kr15AsPrinted, TurnsThetaSixAndAlphaSixRound) {
  const Result result = RunCase(LoadCase("kr15_as_printed"));
  const auto parameters = ByName(*result.best());
  EXPECT_EQ(parameters.at("alpha6").verdict, Verdict::kUnobservable);
  EXPECT_EQ(std::lround(parameters.at("alpha6").correction * 1e6), 0);  // Table III: -320
  // Exact readings see theta6 through a6 = 58 um; an instrument's do not.
  EXPECT_NEAR(parameters.at("theta6").correction * 1e6, 260, 3);  // Table III: 0
}

TEST(Kr15Relative, CannotSeeWhatLiftsAllReadings) {
  const Result result = RunCase(LoadCase("kr15_relative"));
  const auto parameters = ByName(*result.best());
  EXPECT_EQ(result.best()->rank, 22);
  EXPECT_EQ(parameters.at("d1").verdict, Verdict::kUnobservable);
  EXPECT_THAT(parameters.at("d1").explanation, HasSubstr("shifts all measured points alike"));
}

TEST(Kr15Noisy, DefaultRuleReachesTheNoiseFloor) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    ProblemSpec spec = LoadCase("kr15_noisy");
    spec.simulate->seed = seed;
    const Recording recording = RecordingOf(spec);
    const FitResult fit = *RunCase(spec).best();
    EXPECT_TRUE(fit.converged);
    // The floor of this draw: its own noise, of which rank of 300 directions are fitted away.
    spec.simulate->noise = 0;
    const double noise = (recording.p_WQ - RecordingOf(spec).p_WQ).norm() / std::sqrt(300.0);
    EXPECT_NEAR(fit.rms / (std::sqrt(1 - fit.rank / 300.0) * noise), 1.0, 0.02);
    EXPECT_NEAR(fit.rms / (std::sqrt(1 - fit.rank / 300.0) * 20e-6), 1.0, 0.1);
  }
}

TEST(Kr15Noisy, PaperRuleIsReportedAsDivergedWithoutParameters) {
  const Result result = RunCase(LoadCase("kr15_noisy_paper_rule"));
  EXPECT_EQ(result.best(), nullptr);
  ASSERT_EQ(result.fits.size(), 1u);
  EXPECT_EQ(result.fits[0].termination, Termination::kDiverged);
  EXPECT_THAT(result.fits[0].message, HasSubstr("Diverged"));
  EXPECT_TRUE(result.fits[0].parameters.empty());
}

}  // namespace
}  // namespace dhcal
