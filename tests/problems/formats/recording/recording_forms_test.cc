// One good recording in the forms that people write it in: read, or told what to change.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "problems/formats/recording/recording_reader.h"
#include "tests/support/temp_file.h"

namespace dhcal {
namespace {

using testing::HasSubstr;
using Cells = std::vector<std::string>;

constexpr int kRows = 12, kJoints = 6;

/// The numbers as they are written: degrees and millimetres with three decimals.
struct Good {
  Eigen::MatrixXd q{kRows, kJoints};
  Eigen::MatrixXd p{kRows, 3};

  Good() {
    Rng rng(7);
    const auto rounded = [](double x) { return std::round(x * 1000) / 1000; };
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kJoints; ++i) q(row, i) = rounded(rng.Uniform(-170, 170));
      for (int i = 0; i < 3; ++i) p(row, i) = rounded(rng.Uniform(-2900, 2900));
    }
    q(0, 0) = 0.125;
    p(3, 1) = 2392.645;
    p(4, 2) = -0.5;
  }
};

const Good& TheRecording() {
  static const Good good;
  return good;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// How a file writes the recording.
struct Writing {
  Cells joint_names = {"q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"};
  Cells position_names = {"x_mm", "y_mm", "z_mm"};
  std::string separator = ",";
  bool header = true;
  std::string end = "\n";
  std::string row_end;  // behind the last cell of rows
  Cells units;          // a second line of the header
  bool radians = false;
  std::function<std::string(double)> number = [](double x) { return fmt::format("{:.3f}", x); };
};

std::string Joined(const Cells& cells, const std::string& separator) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? separator : "") + cells[i];
  return line;
}

std::string Write(const Writing& writing) {
  const Good& good = TheRecording();
  std::string text;
  Cells names = writing.joint_names;
  names.insert(names.end(), writing.position_names.begin(), writing.position_names.end());
  if (writing.header) text += Joined(names, writing.separator) + writing.end;
  if (!writing.units.empty()) text += Joined(writing.units, writing.separator) + writing.end;
  for (int row = 0; row < kRows; ++row) {
    Cells cells;
    for (int i = 0; i < kJoints; ++i) {
      cells.push_back(writing.radians ? fmt::format("{:.9f}", good.q(row, i) * kDegree)
                                      : writing.number(good.q(row, i)));
    }
    for (int i = 0; i < 3; ++i) cells.push_back(writing.number(good.p(row, i)));
    text += Joined(cells, writing.separator) + writing.row_end + writing.end;
  }
  return text;
}

std::string DecimalComma(double x) { return Replaced(fmt::format("{:.3f}", x), ".", ","); }

/// "-2392.645" -> "-2,392.645" with any separator between thousands and any decimal mark.
std::string Grouped(double x, const std::string& group, const std::string& mark) {
  const std::string plain = fmt::format("{:.3f}", std::abs(x));
  const std::size_t point = plain.find('.');
  std::string text = plain.substr(0, point);
  if (text.size() > 3) text.insert(text.size() - 3, group);
  return (x < 0 ? "-" : "") + text + mark + plain.substr(point + 1);
}

std::string Utf16(const std::string& text, bool little) {
  std::string units = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    units += little ? c : '\0';
    units += little ? '\0' : c;
  }
  return units;
}

struct Form {
  std::string name;
  std::string text;
  std::string says;  // part of the message; "" = no message at all
  bool refused = false;
  Cells robot_names = {"J1", "J2", "J3", "J4", "J5", "J6"};
  std::vector<std::pair<std::string, std::string>> columns = {};
};

const Cells kUrNames = {"shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"};

Cells Numbered(const std::string& before, int first, const std::string& behind) {
  Cells names;
  for (int i = 0; i < kJoints; ++i) names.push_back(before + std::to_string(first + i) + behind);
  return names;
}

/// Names like those of a writing with our own ones.
Form Named(const std::string& name, const Cells& joints, const Cells& position, bool radians) {
  Writing writing;
  writing.joint_names = joints;
  writing.position_names = position;
  writing.radians = radians;
  return {name, Write(writing), "note: columns read by other names"};
}

void AddTexts(std::vector<Form>* forms) {
  using Change = std::function<void(Writing*)>;
  const auto add = [forms](const std::string& name, const std::string& says, const Change& change) {
    Writing writing;
    change(&writing);
    forms->push_back({name, Write(writing), says});
  };
  add("Plain", "", [](Writing*) {});
  add("Semicolons", "read with semicolons between cells\n", [](Writing* w) { w->separator = ";"; });
  add("SemicolonsDecimalCommas",
      "note: read with semicolons between cells and decimal commas\n",
      [](Writing* w) {
        w->separator = ";";
        w->number = DecimalComma;
      });
  add("Tabs", "read with tabs between cells\n", [](Writing* w) { w->separator = "\t"; });
  add("TabsDecimalCommas", "tabs between cells and decimal commas", [](Writing* w) {
    w->separator = "\t";
    w->number = DecimalComma;
  });
  add("Blanks", "read with blanks between cells\n", [](Writing* w) { w->separator = "   "; });
  add("BlanksDecimalCommas", "blanks between cells and decimal commas", [](Writing* w) {
    w->separator = " ";
    w->number = DecimalComma;
  });
  add("BlanksAfterCommas", "", [](Writing* w) { w->separator = ", "; });
  add("TabsAfterCommas", "", [](Writing* w) { w->separator = ",\t"; });
  add("QuotedHeader", "", [](Writing* w) {
    for (std::string& name : w->joint_names) name = "\"" + name + "\"";
  });
  add("QuotedNumbers", "", [](Writing* w) {
    w->number = [](double x) { return fmt::format("\"{:.3f}\"", x); };
  });
  add("QuotedDecimalCommas", "read with decimal commas\n", [](Writing* w) {
    w->number = [](double x) { return "\"" + DecimalComma(x) + "\""; };
  });
  add("CommaAfterRows", "read with the comma at the end of rows\n", [](Writing* w) {
    w->row_end = ",";
  });
  add("CommasAfterHeaderAndRows", "the comma at the end of rows", [](Writing* w) {
    w->position_names.push_back("");
    w->row_end = ",";
  });
  add("SemicolonAfterRows", "the semicolon at the end of rows", [](Writing* w) {
    w->separator = ";";
    w->row_end = ";";
  });
  add("EnglishThousands", "read with commas between thousands\n", [](Writing* w) {
    w->number = [](double x) { return "\"" + Grouped(x, ",", ".") + "\""; };
  });
  const std::pair<const char*, const char*> groups[] = {{"Points", "."},
                                                        {"Blanks", " "},
                                                        {"NoBreakBlanks", "\xC2\xA0"},
                                                        {"NarrowBlanks", "\xE2\x80\xAF"},
                                                        {"Apostrophes", "'"}};
  for (const auto& [name, group] : groups) {
    const std::string between = group;
    add(std::string("ThousandsWith") + name, "between thousands", [&](Writing* w) {
      w->separator = ";";
      w->number = [between](double x) { return Grouped(x, between, ","); };
    });
  }
  add("TypographicMinus", "read with typographic minus signs\n", [](Writing* w) {
    w->number = [](double x) { return Replaced(fmt::format("{:.3f}", x), "-", "\xE2\x88\x92"); };
  });
  add("EnDash", "typographic minus signs", [](Writing* w) {
    w->number = [](double x) { return Replaced(fmt::format("{:.3f}", x), "-", "\xE2\x80\x93"); };
  });
  add("Exponents", "", [](Writing* w) {
    w->number = [](double x) { return fmt::format("{:.10e}", x); };
  });
  add("CarriageReturns", "", [](Writing* w) { w->end = "\r\n"; });
}

void AddUnits(std::vector<Form>* forms) {
  Writing writing;
  writing.joint_names = Numbered("J", 1, "");
  writing.position_names = {"X", "Y", "Z"};
  writing.units = {"deg", "deg", "deg", "deg", "deg", "deg", "mm", "mm", "mm"};
  forms->push_back({"UnitsBelowTheNames", Write(writing), "read with the units in line 2\n"});
  Writing contradictory;
  contradictory.units = {"rad", "deg", "deg", "deg", "deg", "deg", "mm", "mm", "mm"};
  forms->push_back({"UnitsThatContradictTheNames", Write(contradictory), "q1", true});
}

void AddFiles(std::vector<Form>* forms) {
  const std::string plain = Write({});
  Writing german;
  german.separator = ";";
  german.number = DecimalComma;
  Writing no_header;
  no_header.header = false;
  Writing numpy = no_header;
  numpy.separator = " ";
  forms->push_back(
      {"ByteOrderMarkCarriageReturns", "\xEF\xBB\xBF" + Replaced(plain, "\n", "\r\n"), ""});
  forms->push_back({"Utf16Little", Utf16(plain, true), "read with UTF-16 text\n"});
  forms->push_back({"Utf16Big", Utf16(plain, false), "read with UTF-16 text\n"});
  forms->push_back({"ExcelUnicodeText",
                    Utf16(Replaced(Replaced(Write(german), ";", "\t"), "\n", "\r\n"), true),
                    "read with tabs between cells, UTF-16 text and decimal commas\n"});
  forms->push_back({"SepLine", "sep=;\n" + Write(german), "semicolons between cells"});
  forms->push_back({"SepLineComma", "sep=,\n" + plain, ""});
  forms->push_back({"NumpyHeader",
                    "# q1_deg q2_deg q3_deg q4_deg q5_deg q6_deg x_mm y_mm z_mm\n" + Write(numpy),
                    "the names of columns from the comment in line 1"});
  std::string pandas = "," + plain;
  int row = 0;
  for (std::size_t at = pandas.find('\n'); at + 1 < pandas.size(); at = pandas.find('\n', at + 1)) {
    pandas.insert(at + 1, std::to_string(row++) + ",");
  }
  forms->push_back({"PandasIndex", pandas, "the first column left out"});
  forms->push_back(
      {"NoHeader", Write(no_header), "row 1 holds numbers: the header is missing", true});
  forms->push_back({"NoHeaderShowsOne",
                    Write(no_header),
                    "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm",
                    true});
  forms->push_back({"NoHeaderBlanks", Write(numpy), "the header is missing", true});
  Form numbered = {"NoHeaderNumbered", Write(no_header), ""};
  for (int i = 1; i <= kJoints; ++i) {
    numbered.columns.emplace_back(fmt::format("q{}_deg", i), std::to_string(i));
  }
  numbered.columns.insert(numbered.columns.end(), {{"x_mm", "7"}, {"y_mm", "8"}, {"z_mm", "9"}});
  forms->push_back(numbered);
  forms->push_back({"Workbook", std::string("PK\x03\x04\0\0", 6), "save it as 'CSV UTF-8'", true});
  forms->push_back({"DecimalCommasBetweenCommas",
                    Replaced(plain, ".", ","),
                    "are numbers written with decimal commas? Use decimal points",
                    true});
}

void AddNames(std::vector<Form>* forms) {
  const Cells xyz = {"x_mm", "y_mm", "z_mm"};
  const Cells degrees = Numbered("q", 1, "_deg");
  forms->push_back(Named("CapitalX", degrees, {"X_mm", "Y_mm", "Z_mm"}, false));
  forms->push_back(Named("UnitsInBrackets", degrees, {"x [mm]", "y [mm]", "z [mm]"}, false));
  forms->push_back(Named("UnitsInParentheses", degrees, {"X (mm)", "Y (mm)", "Z (mm)"}, false));
  forms->push_back(Named("Measurement",
                         degrees,
                         {"measurement_x [mm]", "measurement_y [mm]", "measurement_z [mm]"},
                         false));
  forms->push_back(Named("JointUnitsInBrackets", Numbered("q", 1, " [deg]"), xyz, false));
  forms->push_back(Named("DegreeSign", Numbered("J", 1, " (\xC2\xB0)"), xyz, false));
  forms->push_back(Named("JointRadians", Numbered("joint_", 1, " [rad]"), xyz, true));
  for (const char* const name : {"J", "A", "joint_", "axis", "Joint ", "theta"}) {
    Form form = Named(std::string("Bare_") + name[0] + std::to_string(std::string(name).size()),
                      Numbered(name, 1, ""),
                      xyz,
                      false);
    form.says = "in degrees, as they go beyond two turns of radians";
    forms->push_back(form);
  }
  forms->push_back(Named("CountedFromZero", Numbered("joint_", 0, "_deg"), xyz, false));
  Form radians = Named("BareRadians", Numbered("J", 1, ""), xyz, true);
  radians.refused = true;
  radians.says =
      "columns: {q1_deg: J1, q2_deg: J2, q3_deg: J3, q4_deg: J4, q5_deg: J5, q6_deg: J6}";
  forms->push_back(radians);
  for (int i = 1; i <= kJoints; ++i) {
    radians.columns.emplace_back(fmt::format("q{}_rad", i), fmt::format("J{}", i));
  }
  radians.name = "BareRadiansMapped";
  radians.refused = false;
  radians.says = "";
  forms->push_back(radians);
  Form bare = Named("PositionWithoutUnit", degrees, {"X", "Y", "Z"}, false);
  bare.refused = true;
  bare.says = "column 'X' looks like a position, but states no unit";
  forms->push_back(bare);
  bare.name = "PositionWithoutUnitMapped";
  bare.refused = false;
  bare.says = "";
  bare.columns = {{"x_mm", "X"}, {"y_mm", "Y"}, {"z_mm", "Z"}};
  forms->push_back(bare);
}

void AddRos(std::vector<Form>* forms) {
  const Cells xyz = {"x_mm", "y_mm", "z_mm"};
  Form array = Named("PlotJugglerArray", Numbered("/joint_states/position[", 0, "]"), xyz, true);
  array.says = "in the order of the file, which in ROS is often the alphabet's, in SI units";
  forms->push_back(array);
  forms->push_back(Named("RosbagArray", Numbered("field.position", 0, ""), xyz, true));
  forms->push_back(Named("UrRealTimeData", Numbered("actual_q_", 0, ""), xyz, true));
  Cells names, names_degrees;
  for (const std::string& name : kUrNames) {
    names.push_back("/joint_states/" + name + "_joint/position");
    names_degrees.push_back(name + "_joint [deg]");
  }
  Form by_name = Named("PlotJugglerNames", names, xyz, true);
  by_name.robot_names = kUrNames;
  forms->push_back(by_name);
  by_name = Named("JointNames", names_degrees, xyz, false);
  by_name.robot_names = kUrNames;
  forms->push_back(by_name);

  // rostopic echo -p: names stand beside the positions, in the alphabet's order.
  const std::vector<int> order = {2, 1, 0, 3, 4, 5};
  const Good& good = TheRecording();
  std::string text = "%time";
  for (int k = 0; k < kJoints; ++k) text += fmt::format(",field.name{}", k);
  for (int k = 0; k < kJoints; ++k) text += fmt::format(",field.position{}", k);
  text += ",x_mm,y_mm,z_mm\n";
  for (int row = 0; row < kRows; ++row) {
    text += fmt::format("{}", 1600000000000000000 + row);
    for (const int joint : order) text += "," + kUrNames[joint] + "_joint";
    for (const int joint : order) text += fmt::format(",{:.9f}", good.q(row, joint) * kDegree);
    for (int i = 0; i < 3; ++i) text += fmt::format(",{:.3f}", good.p(row, i));
    text += "\n";
  }
  forms->push_back(
      {"RostopicEcho", text, "in the order of the names beside them", false, kUrNames});
  forms->push_back(
      {"RostopicEchoOfAnotherRobot", text, "give 'robot.joints' the names of the recording", true});
}

std::vector<Form> AllForms() {
  std::vector<Form> forms;
  AddTexts(&forms);
  AddUnits(&forms);
  AddFiles(&forms);
  AddNames(&forms);
  AddRos(&forms);
  return forms;
}

std::ostream& operator<<(std::ostream& os, const Form& form) { return os << form.name; }

class RecordingForms : public testing::TestWithParam<Form> {};

TEST_P(RecordingForms, LoadWithTheRightNumbersOrSayWhatToChange) {
  const Form& form = GetParam();
  const TempFile file(form.text, ".csv");
  std::vector<JointRow> joints(kJoints);
  for (int i = 0; i < kJoints; ++i) joints[i].name = form.robot_names[i];
  std::vector<ColumnAlias> columns;
  for (const auto& [ours, theirs] : form.columns) columns.push_back({ours, theirs, {}, {}});
  Diagnostics diagnostics;
  const auto recording = ReadRecording(file.path(), joints, columns, &diagnostics);
  const std::string messages = diagnostics.ToString();
  if (form.says.empty()) {
    EXPECT_EQ(messages, "");
  } else {
    EXPECT_THAT(messages, HasSubstr(form.says));
  }
  const bool positions = recording && recording->p_WQ.rows() == kRows;
  EXPECT_EQ(positions, !form.refused) << messages;
  if (!positions || form.refused) return;
  const Good& good = TheRecording();
  ASSERT_EQ(recording->num_rows(), kRows) << messages;
  EXPECT_LT((recording->q - good.q * kDegree).cwiseAbs().maxCoeff(), 1e-9) << messages;
  EXPECT_LT((recording->p_WQ - good.p * kMillimetre).cwiseAbs().maxCoeff(), 1e-15) << messages;
}

INSTANTIATE_TEST_SUITE_P(All, RecordingForms, testing::ValuesIn(AllForms()), [](const auto& param) {
  return param.param.name;
});

TEST(RecordingFormsCount, CoversFortyFormsAtLeast) { EXPECT_GE(AllForms().size(), 40u); }

}  // namespace
}  // namespace dhcal
