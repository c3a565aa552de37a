#include "core/report/html/html_renderer.h"

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/html/html_text.h"
#include "core/report/html/plot_svg.h"
#include "core/report/report.h"
#include "tests/support/example_result.h"
#include "tests/support/pages.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using testing::Not;

// What a user's file may call a joint, a column or itself.
constexpr char kNasty[] = "</title><script>alert('1')</script> & \"<b>\" \xC3\xA9 \xFF \x01_{x}";

/// PATH without any program, as long as it lives.
class NoPrograms {
 public:
  NoPrograms() : path_(std::getenv("PATH")) { setenv("PATH", "/nonexistent", 1); }
  NoPrograms(const NoPrograms&) = delete;
  NoPrograms& operator=(const NoPrograms&) = delete;
  ~NoPrograms() { setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

Plot LinePlot(const std::string& name) {
  Plot plot;
  plot.x = {name, "mm"};
  plot.y = {name, name};
  Plot::Series series;
  series.name = name;
  series.x = {1, 2, 3};
  series.y = {0.25, 1e-3, 2};
  series.sigma = {0.1, 0.1, 0.1};
  plot.series = {series};
  plot.levels = {{name, 1.5}};
  return plot;
}

/// Every kind of block, all texts the same.
Document DocumentSaying(const std::string& text) {
  Document document;
  document.title = document.program = text;
  Table table;
  table.title = text;
  table.columns = {{text, text}, {text, "", 12, Table::Align::kPoint}};
  table.AddRow({text, "1.5"});
  List terms;
  terms.kind = List::Kind::kTerms;
  terms.items = {{text, text, {{text, text, {}}}}};
  document.answer = {{text, {Paragraph{{text}, text}}}};
  document.sections = {{text, {terms, table, Figure{text, {LinePlot(text), LinePlot(text)}}}}};
  return document;
}

std::string ExamplePage() {
  return ToHtml(ReportOf(ExampleSpec(), ExampleRecording(40), [] {
    Result result = ExampleResult();
    result.residuals = ExampleResiduals(ExampleRecording(40));
    return result;
  }()));
}

TEST(HtmlText, IsEscapedWhateverItHolds) {
  EXPECT_EQ(Escaped("a<b>&\"'\x01\x7f"), "a&lt;b&gt;&amp;&quot;&#39;  ");
  EXPECT_EQ(Escaped("\xC3\xA9\xFFz"), "\xC3\xA9\xEF\xBF\xBDz");
}

TEST(HtmlText, IsBase64AsRfc4648HasIt) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xFF\xFE"), "//4=");
}

TEST(HtmlRenderer, LetsNoTextOutOfItsPlace) {
  const std::string page = ToHtml(DocumentSaying(kNasty));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<b>\"")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_EQ(CountOf("</title>", page), 1u);
}

TEST(HtmlRenderer, DrawsPlotsOfAnyText) {
  if (!HasProgram("gnuplot")) GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  const std::string page = ToHtml(DocumentSaying(kNasty));
  EXPECT_EQ(CountOf("<svg", page), 2u);
  EXPECT_THAT(page, Not(HasSubstr("class=\"notice\"")));
}

TEST(HtmlRenderer, NeedsNothingButItself) {
  const std::string page = ExamplePage();
  for (const char* const request : {"<script", " src=", "@import", "url(http", "href=\"http"}) {
    EXPECT_THAT(page, Not(HasSubstr(request)));
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST(HtmlRenderer, GivesEveryElementAnIdOfItsOwn) {
  const std::vector<std::string> ids = MatchesIn(ExamplePage(), "\\sid=[\"']([^\"']*)[\"']");
  const std::set<std::string> different(ids.begin(), ids.end());
  EXPECT_GT(ids.size(), 5u);
  EXPECT_EQ(ids.size(), different.size());
}

TEST(HtmlRenderer, RefersToNothingThatIsNotThere) {
  const std::string page = ExamplePage();
  const std::vector<std::string> ids = MatchesIn(page, "\\sid=[\"']([^\"']*)[\"']");
  const std::set<std::string> there(ids.begin(), ids.end());
  for (const std::string& id : MatchesIn(page, "href=[\"']#([^\"']*)[\"']")) {
    EXPECT_EQ(there.count(id), 1u) << id;
  }
}

TEST(HtmlRenderer, DrawsEveryPlotInThePagesColours) {
  if (!HasProgram("gnuplot")) GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  const std::string page = ExamplePage();
  EXPECT_GE(CountOf("<svg", page), 12u);
  EXPECT_THAT(page, HasSubstr("var(--ink-30)"));
  EXPECT_THAT(page, Not(HasSubstr("rgb(")));
  EXPECT_THAT(page, Not(HasSubstr("\"black\"")));
}

TEST(HtmlRenderer, HoldsTheDataOfItsFigures) {
  Document document;
  document.sections = {{"S", {Figure{"A figure.", {LinePlot("size")}}}}};
  // base64 of the table, as coreutils have it.
  const std::string csv =
      "# plot 1: size [size] over size [mm]\nplot,series,x,y,sigma\n1,size,1,0.25,0.1\n"
      "1,size,2,0.001,0.1\n1,size,3,2,0.1\n1,size,0,1.5,\n";
  const ProcessOutput encoded =
      RunForOutput({"base64", "-w0"}, csv, std::chrono::milliseconds(20000));
  ASSERT_EQ(encoded.end, ProcessOutput::End::kDone);
  EXPECT_THAT(ToHtml(document), HasSubstr("data:text/csv;charset=utf-8;base64," + encoded.text));
}

TEST(HtmlRenderer, SaysWhichPackageGivesThePlots) {
  const NoPrograms none;
  const std::string page = ExamplePage();
  EXPECT_THAT(page, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_THAT(page, HasSubstr("Data (CSV)"));
  EXPECT_THAT(page, HasSubstr("<table>"));
  EXPECT_EQ(CountOf("<svg", page), 0u);
}

TEST(HtmlRenderer, SaysWhatHappenedWhereThereIsNoResult) {
  const std::string page = ToHtml(ReportOf(ExampleSpec(), ExampleRecording(), DivergedResult()));
  EXPECT_THAT(page, HasSubstr("No usable result"));
  EXPECT_THAT(page, HasSubstr("The cost grew from 17 to 1.3e+12 in 20 iterations."));
}

TEST(HtmlRenderer, StaysSmallWithManyRows) {
  const Recording recording = ExampleRecording(12000);
  Result result = ExampleResult();
  result.residuals = ExampleResiduals(recording);
  const auto start = std::chrono::steady_clock::now();
  const std::string page = ToHtml(ReportOf(ExampleSpec(), recording, result));
  EXPECT_LT(page.size(), 3u << 20);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));  // usual: below 1
  EXPECT_THAT(page, HasSubstr(" row of 12000."));
}

TEST(PlotSvg, IsDrawnForEveryKindOfMark) {
  if (!HasProgram("gnuplot")) GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  using Mark = Plot::Mark;
  std::vector<Plot> plots;
  for (const bool lying : {false, true}) {
    for (const Mark mark : {Mark::kLine, Mark::kPoints, Mark::kBars, Mark::kCells}) {
      plots.push_back(LinePlot("p"));
      plots.back().lying = lying;
      plots.back().x.names = {"a", "it's", "c", "d"};
      plots.back().series[0].mark = mark;
      if (mark == Mark::kBars || mark == Mark::kCells) plots.back().series[0].sigma.clear();
    }
  }
  for (const Mark mark : {Mark::kCurve, Mark::kSteps, Mark::kArrows}) {
    plots.push_back(LinePlot("p"));
    Plot::Series& series = plots.back().series[0];
    series.mark = mark;
    series.sigma.clear();
    if (mark == Mark::kArrows) series.dx = series.dy = {1, 2, 3};
  }
  plots.back().same_scale = true;
  const DrawnPlots drawn = DrawPlots(plots);
  EXPECT_EQ(drawn.why_not, "");
  ASSERT_EQ(drawn.svg.size(), plots.size());
  for (const std::string& svg : drawn.svg) EXPECT_THAT(svg, HasSubstr("var(--ink-"));
}

}  // namespace
}  // namespace dhcal
