#include "core/io/cell_table.h"

#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dhcal {
namespace {

using testing::HasSubstr;

struct Read {
  std::optional<CellTable> table;
  std::string messages;
};

Read ReadText(const std::string& text) {
  FileErrors errors("f");
  Read read;
  read.table = ParseTable("f", text, &errors);
  Diagnostics diagnostics;
  errors.Report(&diagnostics);
  read.messages = diagnostics.ToString();
  return read;
}

TEST(CellTable, PlacesStayRightWhereNumbersWereMadePlain) {
  // Signs, blanks and quotes of several bytes or characters before the cell looked at.
  const Read read = ReadText(
      "a;b;c\n\xE2\x88\x92"
      "1\xE2\x80\xAF"
      "234,5;\"2,5\";x\n");
  ASSERT_TRUE(read.table.has_value()) << read.messages;
  EXPECT_EQ(read.table->cell(0, 0), "-1234.5");
  EXPECT_EQ(read.table->cell(0, 1), "2.5");
  EXPECT_EQ(read.table->CellWhere(0, 2).ToString(), "f:2:16");
}

TEST(CellTable, SeparatorIsTheOneUnderWhichRowsAreNumbers) {
  EXPECT_EQ(ReadText("a;b\n1,5;2,5\n").table->format().separator, ';');
  EXPECT_EQ(ReadText("a,b,c\n1,2,x;y\n").table->format().separator, ',');
  EXPECT_EQ(ReadText("1,5\t-2,5\n").table->format().separator, '\t');
  EXPECT_EQ(ReadText("1,5 -2,5\n").table->format().separator, ' ');
  EXPECT_EQ(ReadText("x (mm)\n1\n2\n").table->num_columns(), 1);
  EXPECT_EQ(ReadText("x [mm]  y [mm]\n1 2\n").table->name(1), "y [mm]");
  EXPECT_EQ(ReadText("x [mm], y [mm]\n1, 2\n").table->name(1), "y [mm]");
}

TEST(CellTable, OneNoteSaysWhatWasTakenHow) {
  EXPECT_EQ(ReadText("a,b\n1,2\n").messages, "");
  EXPECT_EQ(ReadText("a;b\n1,5;nan\n1.234,5;-\n").messages,
            "f: note: read with semicolons between cells, decimal commas, points between thousands "
            "and 'nan' and '-' as blank cells\n");
}

TEST(CellTable, ALineOfUnitsBelongsToTheNames) {
  const auto with_units = [](const std::string& text) {
    FileErrors errors("f");
    return ParseTable("f", text, &errors, [](std::string_view cell) { return cell == "mm"; });
  };
  const auto table = with_units("x;y;set\nmm;[mm];-\n1;2;a\n");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->num_rows(), 1);
  EXPECT_EQ(table->name(1), "y [mm]");
  EXPECT_EQ(table->own_name(1), "y");
  EXPECT_EQ(table->name(2), "set");
  EXPECT_EQ(with_units("x,y\nmm,a\n1,2\n")->num_rows(), 2) << "a is no unit";
  EXPECT_EQ(with_units("x,y\n-,-\n1,2\n")->num_rows(), 2) << "blank cells are none";
  EXPECT_EQ(with_units("x,y\n1,2\nmm,mm\n")->num_rows(), 2) << "not below the names";
}

TEST(CellTable, ErrorValuesAtTheStartOfARowAreNoComments) {
  const Read read = ReadText("a,b\n#N/A,1\n# comment\n2,3\n");
  ASSERT_EQ(read.table->num_rows(), 2);
  EXPECT_EQ(read.table->cell(0, 0), "");
}

TEST(CellTable, OtherColumnsTellTheDecimalMark) {
  const Read read = ReadText("a\tb\n1,234\t0,5\n5,678\t12,25\n");
  EXPECT_EQ(read.table->cell(0, 0), "1.234");
  EXPECT_EQ(read.table->doubt(0).message, "");
  const Read open = ReadText("a\tb\n1,234\t5\n5,678\t6\n");
  EXPECT_THAT(open.table->doubt(0).message, HasSubstr("'1,234' may be 1234 or 1.234"));
  EXPECT_EQ(open.table->doubt(1).message, "");
}

TEST(CellTable, AnyBytesAreReadOrRefused) {
  const std::string alphabet = "0123456789.,;:\t \n\r\"'#+-eEaxNn/[]()\xE2\x88\x92\xC2\xA0";
  std::mt19937 generator(5);
  for (int k = 0; k < 3000; ++k) {
    std::string text;
    const std::size_t length = generator() % 120;
    for (std::size_t i = 0; i < length; ++i) text += alphabet[generator() % alphabet.size()];
    const Read read = ReadText(text);
    if (!read.table) {
      EXPECT_NE(read.messages, "");
      continue;
    }
    for (int row = 0; row < read.table->num_rows(); ++row) {
      for (int i = 0; i < read.table->num_columns(); ++i) {
        EXPECT_GE(read.table->CellWhere(row, i).column, 1);
      }
    }
  }
}

}  // namespace
}  // namespace dhcal
