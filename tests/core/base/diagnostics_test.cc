#include "core/base/diagnostics.h"

#include <string>

#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(SourceLocation, LeavesOutWhatIsUnknown) {
  EXPECT_EQ((SourceLocation{"a.yaml", 12, 3}).ToString(), "a.yaml:12:3");
  EXPECT_EQ((SourceLocation{"a.yaml", 12, 0}).ToString(), "a.yaml:12");
  EXPECT_EQ((SourceLocation{"a.yaml", 0, 3}).ToString(), "a.yaml");
  EXPECT_EQ(SourceLocation().ToString(), "");
}

/// GCC 12 takes an unnamed Diagnostic{...} for uninitialised when it inlines its destructor.
std::string Said(Severity severity, const SourceLocation& where, const std::string& message) {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.where = where;
  diagnostic.message = message;
  return diagnostic.ToString();
}

TEST(Diagnostic, SaysPlaceKindAndMessage) {
  EXPECT_EQ(Said(Severity::kError, {"a.csv", 4, 1}, "no number"), "a.csv:4:1: error: no number");
  EXPECT_EQ(Said(Severity::kWarning, {"a.csv"}, "unknown column"),
            "a.csv: warning: unknown column");
  EXPECT_EQ(Said(Severity::kError, {}, "no input"), "error: no input");
}

TEST(Diagnostics, IsOkUntilTheFirstError) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.ok());
  diagnostics.Warning({"a", 1, 1}, "odd");
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(diagnostics.num_errors(), 0);
  diagnostics.Error({"a", 2, 1}, "wrong");
  EXPECT_FALSE(diagnostics.ok());
  EXPECT_EQ(diagnostics.num_errors(), 1);
}

TEST(Diagnostics, KeepsAllMessagesInTheOrderFound) {
  Diagnostics diagnostics;
  EXPECT_EQ(diagnostics.ToString(), "");
  diagnostics.Error({"a", 9, 1}, "first");
  diagnostics.Warning({"a", 2, 0}, "second");
  diagnostics.Error({}, "third");
  EXPECT_EQ(diagnostics.ToString(), "a:9:1: error: first\na:2: warning: second\nerror: third\n");
  ASSERT_EQ(diagnostics.all().size(), 3u);
  EXPECT_EQ(diagnostics.all()[1].severity, Severity::kWarning);
  EXPECT_EQ(diagnostics.all()[2].message, "third");
  EXPECT_EQ(diagnostics.num_errors(), 2);
}

}  // namespace
}  // namespace dhcal
