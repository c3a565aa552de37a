// The report is data: a second renderer, which knows nothing but the document, says all that
// report.txt says.
#include "core/report/document.h"

#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/report.h"
#include "core/report/text_renderer.h"
#include "tests/core/report/markdown_renderer.h"
#include "tests/support/example_result.h"

namespace dhcal {
namespace {

using testing::HasSubstr;

/// A report with every kind of section: two solvers, effects, a diagnosis with all that it may
/// hold.
Result WholeResult() {
  Result result = ExampleResult();
  ParameterResult effect;
  effect.name = "joint_compliance_2.compliance";
  effect.unit = Unit::kOther;
  effect.unit_text = "rad/(N m)";
  effect.value = 1.5e-6;
  effect.sigma = 2e-8;
  effect.verdict = Verdict::kIdentified;
  result.fits[0].parameters.push_back(effect);
  DiagnosisResult& d = result.diagnosis.emplace();
  d.verdict = DiagnosisVerdict::kPartlyExplained;
  d.summary = "explained in part";
  d.false_alarm = 0.01;
  d.misfit = {900, 40, 1e-12, 1e-13, 3e-5, true, 3e-4, 300, 2, {6, 40}, ""};
  d.map = {{"theta3", "q3", 412.5, 5, 1e-20, 2e-4}};
  Finding finding;
  finding.effect.effect = "joint_compliance";
  finding.effect.joint = 2;
  finding.effect_class = "C1";
  finding.location = "theta2";
  finding.driver = "gravity torque";
  finding.sentence = "joint 2 yields";
  finding.cautions = {"its size rests on the masses"};
  finding.rms_train_before = 3e-4;
  finding.rms_train_after = 1e-4;
  finding.p_value = 1e-9;
  Confusable other;
  other.effect.effect = "link_bending";
  other.effect.joint = 2;
  other.overlap = 0.97;
  finding.confusable_with = {other};
  finding.separating_advice = "to tell it from link_bending: the poses listed";
  finding.separating_poses = {{Eigen::VectorXd::Constant(6, 0.5), 15}};
  d.findings = {finding};
  d.moved = {{"theta2", Unit::kRadian, 1e-3, 2e-3, 1e-5}};
  d.unexplained = Unexplained{0.3, "theta3", "q3", "rad", Unit::kRadian, 1e-4, {}};
  d.unexplained->curve = {{-0.5, 1e-4, 1e-5}, {0.5, -2e-4, 1e-5}};
  HiddenRisk risk;
  risk.effect.effect = "backlash";
  risk.visibility = 0.5;
  risk.limit = 2e-5;
  risk.unit = "rad";
  risk.risk = 1e-4;
  d.hidden = {risk};
  d.not_testable = {{"thermal_growth", "no temperature"}};
  d.notes = {"A note on the search."};
  d.validation_method = "blocked k-fold";
  d.rms_train_before = 3e-4;
  d.rms_train_after = 1e-4;
  d.rms_test_before = 3.1e-4;
  d.rms_test_after = 1.1e-4;
  return result;
}

/// Words and numbers, without what a renderer draws around them.
std::multiset<std::string> PlainWords(const std::string& text) {
  std::multiset<std::string> words;
  std::string plain;
  for (const char c : text) {
    if (c == '\\') continue;
    const bool drawn = c == '|' || c == '*' || c == '[' || c == ']' || c == '#' || c == '=';
    plain += drawn ? ' ' : c;
  }
  std::istringstream stream(plain);
  for (std::string word; stream >> word;) words.insert(word);
  return words;
}

/// All figures of a document.
std::vector<Figure> FiguresOf(const Document& document) {
  std::vector<Figure> figures;
  for (const Section& section : document.sections) {
    for (const Block& block : section.blocks) {
      if (const auto* const figure = std::get_if<Figure>(&block)) figures.push_back(*figure);
    }
  }
  return figures;
}

TEST(Document, IsSaidInFullByASecondRenderer) {
  const Document report = ReportOf(ExampleSpec(), ExampleRecording(), WholeResult());
  std::multiset<std::string> markdown = PlainWords(MarkdownRenderer()(report));
  for (const std::string& word : PlainWords(ToText(report))) {
    // Entries of a list are numbered by whoever reads the Markdown.
    if (word == "2." || word == "-") continue;
    const auto found = markdown.find(word);
    EXPECT_NE(found, markdown.end()) << "'" << word << "' is not, or less often, in the Markdown";
    if (found != markdown.end()) markdown.erase(found);
  }
}

TEST(Document, OfAFailureIsSaidInFullByASecondRenderer) {
  const std::string markdown =
      MarkdownRenderer()(ReportOf(ExampleSpec(), ExampleRecording(), DivergedResult()));
  EXPECT_THAT(markdown, HasSubstr("## NO USABLE RESULT"));
  EXPECT_THAT(markdown, HasSubstr("The cost grew from 17 to 1.3e+12 in 20 iterations."));
}

TEST(Document, HasNoEmptySections) {
  Result bare;
  bare.fits.resize(1);
  for (const Document& report : {ReportOf(ExampleSpec(), ExampleRecording(), WholeResult()),
                                 ReportOf(ExampleSpec(), ExampleRecording(), DivergedResult()),
                                 ReportOf(ProblemSpec(), ExampleRecording(), bare)}) {
    for (const Section& section : report.sections) EXPECT_FALSE(section.empty()) << section.title;
  }
}

TEST(Document, TablesHaveACellForEachColumnOrSayWhatIsLeftOut) {
  int tables = 0;
  for (const Section& section :
       ReportOf(ExampleSpec(), ExampleRecording(), WholeResult()).sections) {
    for (const Block& block : section.blocks) {
      const auto* const table = std::get_if<Table>(&block);
      if (table == nullptr) continue;
      ++tables;
      for (const Table::Row& row : table->rows) {
        EXPECT_EQ(row.cells.size(), row.left_out > 0 ? 0 : table->columns.size()) << section.title;
      }
      for (const Table::Column& column : table->columns) {
        EXPECT_EQ(column.unit.find_first_of("[]"), std::string::npos) << column.unit;
      }
    }
  }
  EXPECT_EQ(tables, 12);
}

/// All axes of all figures.
std::vector<Plot> PlotsOf(const Document& document) {
  std::vector<Plot> plots;
  for (const Figure& figure : FiguresOf(document)) {
    plots.insert(plots.end(), figure.plots.begin(), figure.plots.end());
  }
  return plots;
}

TEST(Document, FiguresCanBeDrawn) {
  const Document report = ReportOf(ExampleSpec(), ExampleRecording(), WholeResult());
  for (const Figure& figure : FiguresOf(report)) {
    EXPECT_EQ(figure.caption.back(), '.') << figure.caption;
    EXPECT_FALSE(figure.plots.empty()) << figure.caption;
  }
  for (const Plot& plot : PlotsOf(report)) {
    EXPECT_FALSE(plot.y.title.empty());
    EXPECT_FALSE(plot.x.title.empty() && plot.x.names.empty()) << plot.y.title;
    EXPECT_FALSE(plot.series.empty()) << plot.y.title;
    for (const Plot::Series& series : plot.series) {
      ASSERT_EQ(series.x.size(), series.y.size()) << plot.y.title;
      EXPECT_TRUE(series.sigma.empty() || series.sigma.size() == series.y.size());
      EXPECT_FALSE(series.on_right && !plot.y_right) << plot.y.title;
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        EXPECT_TRUE(std::isfinite(series.x[i]) && std::isfinite(series.y[i])) << plot.y.title;
        EXPECT_TRUE(!plot.y.logarithmic || series.y[i] > 0) << plot.y.title;
        EXPECT_TRUE(!plot.x.logarithmic || series.x[i] > 0) << plot.x.title;
      }
    }
  }
}

TEST(Document, HasAFigureOfAllThatTheResultHolds) {
  const Document report = ReportOf(ExampleSpec(), ExampleRecording(), WholeResult());
  std::vector<std::string> captions;
  for (const Figure& figure : FiguresOf(report)) captions.push_back(figure.caption);
  using testing::Contains;
  using testing::StartsWith;
  for (const char* const of : {"Joint positions",
                               "Errors of all",
                               "Errors over the workspace",
                               "What is not explained",
                               "Evidence",
                               "Detection limits",
                               "Corrections",
                               "Errors in the order",
                               "What calibrated.yaml leaves",
                               "Convergence",
                               "Singular values",
                               "Mismatch map"}) {
    EXPECT_THAT(captions, Contains(StartsWith(of)));
  }
}

TEST(Document, HasNoFigureWhereThereIsNothingToShow) {
  Result bare = ExampleResult();
  bare.residuals.clear();
  bare.fits.resize(1);
  bare.fits[0].trace.clear();
  bare.fits[0].singular_values.clear();
  bare.fits[0].parameters.clear();
  EXPECT_THAT(FiguresOf(ReportOf(ExampleSpec(), Recording(), bare)), testing::IsEmpty());
}

TEST(Document, FiguresHoldTheNumbersOfTheResult) {
  const Result result = WholeResult();
  const FitResult& fit = result.fits[0];
  bool spectrum = false, cost = false;
  for (const Plot& plot : PlotsOf(ReportOf(ExampleSpec(), ExampleRecording(), result))) {
    if (plot.y.title == "singular value") {
      spectrum = true;
      EXPECT_EQ(plot.series[0].y, fit.singular_values);
      ASSERT_EQ(plot.levels.size(), 1u);
      EXPECT_EQ(plot.levels[0].y, fit.truncation_cut);
    } else if (plot.y.title == "cost") {
      cost = true;
      ASSERT_EQ(plot.series.size(), 2u);
      ASSERT_EQ(plot.series[1].y.size(), result.fits[1].trace.size());
      EXPECT_EQ(plot.series[1].y.back(), result.fits[1].trace.back().cost);
    }
  }
  EXPECT_TRUE(spectrum && cost);
}

TEST(Document, HistogramCountsEveryRowOnce) {
  for (const Plot& plot : PlotsOf(ReportOf(ExampleSpec(), ExampleRecording(), WholeResult()))) {
    if (plot.x.title != "error of a row") continue;
    for (const Plot::Series& series : plot.series) {
      double sum = 0;
      for (const double share : series.y) sum += share;
      // Of the bars the sum, of the running sum the last.
      EXPECT_NEAR(series.on_right ? series.y.back() : sum, 100, 1e-9);
    }
    return;
  }
  FAIL() << "no histogram";
}

TEST(Document, OpensWithTheAnswerAndHowFarToTrustIt) {
  const Document report = ReportOf(ExampleSpec(), ExampleRecording(), WholeResult());
  ASSERT_GE(report.answer.size(), 4u);
  EXPECT_EQ(report.answer[report.answer.size() - 2].title, "What can be trusted");
  Document answer = report;
  answer.sections = report.answer;
  const std::string text = ToText(answer);
  EXPECT_THAT(text, HasSubstr("Tested on 2 rows that were never fitted"));
  EXPECT_THAT(text, HasSubstr("Of 23 numbers of the geometry 19 are measured"));
}

}  // namespace
}  // namespace dhcal
