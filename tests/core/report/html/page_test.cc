// The page in a browser: nothing is requested, nothing complained about, nothing wider than the
// window.
#include <chrono>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/html/html_renderer.h"
#include "core/report/report.h"
#include "tests/support/example_result.h"
#include "tests/support/pages.h"
#include "tests/support/temp_folder.h"

namespace dhcal {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kStartOfBrowser(120);

/// What headless Chromium prints of a page, its log among it.
std::string InBrowser(const std::string& file, const std::string& options) {
  const std::string command = fmt::format(
      "chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files "
      "--user-data-dir='{0}.profile' --enable-logging=stderr --virtual-time-budget=4000 {1} "
      "'file://{0}' 2>&1",
      file,
      options);
  return RunForOutput({"sh", "-c", command}, "", kStartOfBrowser).text;
}

/// The page with a script that tells its parent how it fits and what its policy had to refuse.
std::string Probed(std::string page) {
  const std::string policy = "default-src 'none'";
  page.insert(page.find(policy) + policy.size(), "; script-src 'unsafe-inline'");
  const std::string probe =
      "<script>let refused=0;addEventListener('securitypolicyviolation',()=>++refused);"
      "addEventListener('load',()=>setTimeout(()=>{const d=document.documentElement;"
      "parent.postMessage('window '+innerWidth+' overflow '+(d.scrollWidth-d.clientWidth)+"
      "' refused '+refused,'*')},100))</script>";
  return page.insert(page.find("<title>"), probe);
}

class PageTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasProgram("chromium"))
      GTEST_SKIP() << "chromium is not installed: apt-get install chromium";
    Result result = ExampleResult();
    result.residuals = ExampleResiduals(ExampleRecording(40));
    result.notes = {"A_very_long_name_of_a_column_without_any_blank_in_it_that_nobody_would_type"};
    page_ = ToHtml(ReportOf(ExampleSpec(), ExampleRecording(40), result));
  }

  /// What a page says of itself in a window of `width` pixels; browsers' own have a least width.
  std::string InFrame(const std::string& page, int width) {
    WriteFile(folder_ / "probed.html", page);
    WriteFile(folder_ / "frame.html",
              fmt::format("<!DOCTYPE html><body><script>addEventListener('message',"
                          "e=>document.body.append(e.data))</script><iframe width={} height=900 "
                          "style='border:0' src=probed.html></iframe></body>",
                          width));
    return InBrowser(folder_ / "frame.html", "--window-size=1400,1000 --dump-dom");
  }

  const TempFolder folder_;
  std::string page_;
};

TEST_F(PageTest, IsShownWithoutComplaint) {
  WriteFile(folder_ / "report.html", page_);
  const std::string log = InBrowser(folder_ / "report.html", "--dump-dom");
  EXPECT_THAT(log, HasSubstr("</main>"));
  EXPECT_THAT(log, Not(HasSubstr("CONSOLE")));
}

TEST_F(PageTest, FitsWideAndNarrowWindowsAndRequestsNothing) {
  for (const int width : {1280, 400}) {
    EXPECT_THAT(InFrame(Probed(page_), width),
                HasSubstr(fmt::format("window {} overflow 0 refused 0", width)));
  }
}

// What the test above would see otherwise.
TEST_F(PageTest, IsFoundOutWhereItIsTooWideOrRequestsAnything) {
  std::string page = Probed(page_);
  page.insert(page.find("</main>"), "<div style='width:5000px'>wide</div><img src='other.png'>");
  EXPECT_THAT(InFrame(page, 400), ContainsRegex("window 400 overflow 4[0-9]+ refused 1"));
}

}  // namespace
}  // namespace dhcal
