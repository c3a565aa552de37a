#include "core/report/text_table.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

TEST(TextTable, AlignsDecimalPointsAndSaysWhatWasLeftOut) {
  Table table;
  table.title = "A title";
  table.columns = {{"name", "", 200, Table::Align::kLeft},
                   {"value", "mm", 12, Table::Align::kPoint}};
  table.AddRow({"a", "-1.25"});
  table.AddRow({"b", "10"});
  table.AddLeftOut(3);
  table.AddRow({"c", "1.3e-09"});
  EXPECT_EQ(ToText(table),
            "  A title\n"
            "  name    value\n"
            "           [mm]\n"
            "  a       -1.25\n"
            "  b       10\n"
            "  ... and 3 more in result.json\n"
            "  c     1.3e-09\n");
}

TEST(TextTable, ShortensTheFirstColumnWhereRoomIsShort) {
  Table table;
  table.columns = {{"name", "", 200, Table::Align::kLeft}, {"value", ""}};
  table.AddRow({std::string(150, 'n'), "1"});
  const std::string text = ToText(table);
  EXPECT_THAT(text, testing::HasSubstr("nn..nn"));
  EXPECT_EQ(text.size() - text.find('\n') - 2, 100u);
}

TEST(TextTable, OfOneColumnTellsItsCellsFromWhatWasLeftOut) {
  Table table;
  table.columns = {{"name", "", 4, Table::Align::kLeft}};
  table.AddRow({"a long name"});
  table.AddLeftOut(1);
  EXPECT_EQ(ToText(table), "  name\n  a..e\n  ... and 1 more in result.json\n");
}

}  // namespace
}  // namespace dhcal
