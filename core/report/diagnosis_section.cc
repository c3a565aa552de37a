// The report's section on left-out physics.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"
#include "core/physics/effect.h"
#include "core/report/format.h"
#include "core/report/sections.h"
#include "core/report/text_table.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostMap = 6;
constexpr std::size_t kMostConfusable = 6;
constexpr std::size_t kMostHidden = 8;
constexpr std::size_t kMostPoses = 4;
constexpr std::size_t kMostNotTestable = 12;
constexpr std::size_t kMostOutliers = 30;

std::string Upper(std::string text) {
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::toupper(c));
  return text;
}

std::string Probability(double p) {
  if (std::isnan(p)) return "-";
  if (p < 1e-99) return "<1e-99";
  return p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.3f}", p);
}

/// How a joint's coordinate is printed.
struct JointUnit {
  double size = 1;  // [SI]
  std::string name;
};

JointUnit UnitOfJoint(const RobotModel& robot, int joint) {
  const bool slides = joint < robot.num_joints() &&
                      robot.joints[static_cast<std::size_t>(joint)].type == JointType::kPrismatic;
  return slides ? JointUnit{kMillimetre, "mm"} : JointUnit{kDegree, "deg"};
}

/// Unit of what drives a curve: a joint's coordinate ("q3"), or something else as it stands.
JointUnit UnitOfDriver(const RobotModel& robot, const std::string& driver) {
  for (int joint = 0; joint < robot.num_joints(); ++joint) {
    if (driver == fmt::format("q{}", joint + 1)) return UnitOfJoint(robot, joint);
  }
  return {};
}

std::string MisfitWords(const DiagnosisResult& d) {
  const Misfit& m = d.misfit;
  // Nothing was measured where the complete geometry has no fit; the summary says so.
  if (m.rows < 0) return "";
  const std::string noise =
      m.noise_known
          ? fmt::format("known noise of {}", WithMillimetres(m.noise_sigma))
          : fmt::format(
                "noise not given (RMS with the geometry's freedoms counted {}), so only the "
                "pattern of the residuals speaks, not their size",
                WithMillimetres(m.noise_sigma));
  std::string text = fmt::format(
      "Complete geometry leaves {} RMS per coordinate over {} rows; {}. Probability that noise "
      "alone looks like this: {} (alarm below {:g}).",
      WithMillimetres(m.rms),
      m.rows,
      noise,
      Probability(m.p_value),
      d.false_alarm);
  if (m.outliers > 0) {
    text += fmt::format(" {} set aside as outliers", Counted(m.outliers, "row"));
    std::vector<std::string> rows;
    for (const int row : m.outlier_rows) {
      if (rows.size() < kMostOutliers) rows.push_back(std::to_string(row));
    }
    if (m.outlier_rows.size() > rows.size()) rows.push_back("...");
    text += rows.empty() ? "." : fmt::format(" (row {}).", fmt::join(rows, ", "));
  }
  return Wrap("  ", text);
}

std::string BeforeAfter(const Finding& f) {
  if (std::isnan(f.rms_train_before)) return "";
  std::string text = fmt::format("RMS on fitted rows {} -> {} mm",
                                 Millimetres(f.rms_train_before),
                                 Millimetres(f.rms_train_after));
  if (!std::isnan(f.rms_test_before)) {
    text += fmt::format(", on rows not fitted {} -> {} mm",
                        Millimetres(f.rms_test_before),
                        Millimetres(f.rms_test_after));
  }
  return text + fmt::format(" (p = {})", Probability(f.p_value));
}

/// "10.0, -20.0 deg"; with a prismatic joint each its own unit: "10.0 deg, 250.0 mm".
std::string PoseWords(const RobotModel& robot, const Eigen::VectorXd& q) {
  const bool all_turn =
      std::all_of(robot.joints.begin(), robot.joints.end(), [](const JointRow& row) {
        return row.type == JointType::kRevolute;
      });
  std::vector<std::string> joints;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const JointUnit unit = UnitOfJoint(robot, static_cast<int>(k));
    joints.push_back(fmt::format("{:.1f}", q[k] / unit.size) +
                     (all_turn ? std::string() : fmt::format(" {}", unit.name)));
  }
  return fmt::format("{}{}", fmt::join(joints, ", "), all_turn ? " deg" : "");
}

std::string FindingWords(const RobotModel& robot, std::size_t number, const Finding& f) {
  std::string sentence = f.sentence;
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::toupper(sentence[0]));
  std::string text = "\n" + Wrap(fmt::format("  {}. ", number), sentence + ".");
  const std::string driver =
      f.driver == "constant" ? "the same at all poses" : "driven by " + f.driver;
  text += Wrap(
      "     ",
      fmt::format(
          "{}: {}, {}, class {}.", InstanceName(f.effect), f.location, driver, f.effect_class));
  const std::string rms = BeforeAfter(f);
  if (!rms.empty()) text += Wrap("     ", rms + ".");
  for (const std::string& caution : f.cautions) text += Wrap("     Caution: ", caution + ".");
  if (!f.confusable_with.empty()) {
    std::vector<std::string> names;
    for (const Confusable& other : f.confusable_with) {
      if (names.size() == kMostConfusable) break;
      names.push_back(
          fmt::format("{} (likeness {:.2f})", InstanceName(other.effect), other.overlap));
    }
    const std::size_t more = f.confusable_with.size() - names.size();
    if (more > 0) names.push_back(AndMore(more));
    text +=
        Wrap("     These poses do not tell it from: ", fmt::format("{}.", fmt::join(names, "; ")));
  }
  if (!f.separating_advice.empty()) text += Wrap("     Measure next, ", f.separating_advice + ".");
  for (std::size_t k = 0; k < f.separating_poses.size() && k < kMostPoses; ++k) {
    text += Wrap("       pose: ", PoseWords(robot, f.separating_poses[k].q));
  }
  return text;
}

std::string RestWords(const RobotModel& robot, const DiagnosisResult& d) {
  if (!d.unexplained) return "";
  const Unexplained& rest = *d.unexplained;
  std::string text =
      "\n" +
      Wrap("  Not explained: ",
           fmt::format("{:.0f} % of the misfit ({} RMS per coordinate); largest at {} against "
                       "{}.",
                       100 * rest.fraction,
                       WithMillimetres(rest.rms),
                       rest.slot,
                       rest.driver));
  if (rest.curve.empty()) return text;
  const bool angle = rest.unit == "rad";
  const JointUnit driver = UnitOfDriver(robot, rest.driver);
  TextTable table({{rest.driver, driver.name.empty() ? "" : "[" + driver.name + "]"},
                   {rest.slot, angle ? "[mrad]" : "[mm]"},
                   {"+-", angle ? "[mrad]" : "[mm]"}});
  for (const CurvePoint& point : rest.curve) {
    table.AddRow({FixedWithin(point.driver_value / driver.size, 1, 10),
                  Fixed(point.amount / 1e-3, 3),
                  Fixed(point.sigma / 1e-3, 3)});
  }
  return text + table.ToString();
}

std::string MapTable(const DiagnosisResult& d) {
  if (d.map.empty()) return "";
  TextTable table({{"where", "", 12, TextTable::Align::kLeft},
                   {"driven by", "", 34, TextTable::Align::kLeft},
                   {"statistic", ""},
                   {"freedom", ""},
                   {"p alone", ""},
                   {"size", "[mm RMS]"}});
  for (std::size_t k = 0; k < d.map.size() && k < kMostMap; ++k) {
    const MapEntry& entry = d.map[k];
    table.AddRow({entry.slot,
                  entry.driver,
                  Fixed(entry.statistic, 1),
                  Fixed(entry.dof, 0),
                  Probability(entry.p_value),
                  Millimetres(entry.rms)});
  }
  return "\n  Mismatch map (strongest of all places and drivers; the whole is in result.json)\n" +
         table.ToString();
}

std::string MovedTable(const DiagnosisResult& d) {
  if (d.moved.empty()) return "";
  TextTable table({{"parameter", "", 20, TextTable::Align::kLeft},
                   {"without", "[mm, mrad]"},
                   {"with the effects", "[mm, mrad]"},
                   {"+-", "[mm, mrad]"}});
  for (const MovedParameter& p : d.moved) {
    const int decimals = DecimalsOf(p.sigma / 1e-3, 4);
    table.AddRow({p.name,
                  Fixed(p.before / 1e-3, decimals),
                  Fixed(p.after / 1e-3, decimals),
                  Fixed(p.sigma / 1e-3, decimals)});
  }
  return "\n  Corrections that had swallowed part of it\n" + table.ToString();
}

/// A limit that says something: a number, or that no size would be found (NaN, "never").
bool IsLimit(double limit) { return std::isnan(limit) || (std::isfinite(limit) && limit > 0); }

std::string HiddenTable(const DiagnosisResult& d) {
  std::vector<HiddenRisk> shown;
  for (const HiddenRisk& risk : d.hidden) {
    if (shown.size() < kMostHidden && IsLimit(risk.limit)) shown.push_back(risk);
  }
  if (shown.empty()) return "";
  TextTable table({{"not excluded", "", 44, TextTable::Align::kLeft},
                   {"visible", "[part]"},
                   {"smallest found", "[SI]"},
                   {"unit", "", 22, TextTable::Align::kLeft},
                   {"risk elsewhere", "[mm]"}});
  for (const HiddenRisk& risk : shown) {
    table.AddRow({InstanceName(risk.effect),
                  Fixed(risk.visibility, 3),
                  std::isnan(risk.limit) ? "never" : Scientific(risk.limit, 1),
                  risk.unit,
                  std::isnan(risk.risk) ? "-" : Fixed(risk.risk / kMillimetre, 2)});
  }
  return "\n" +
         Wrap("  ",
              "What these rows cannot exclude, and the largest error that it may cause at other "
              "poses (95 %, geometry refitted; joints 120 deg around the recorded middle):") +
         table.ToString();
}

/// How all that was found does together, as far as it is known: where only geometry was found there
/// is no refit, and the numbers are of the file's own geometry and the complete one.
std::string TogetherWords(const DiagnosisResult& d) {
  if (std::isnan(d.rms_test_before)) return "";
  const std::string unseen = fmt::format("on rows not fitted ({}) {} -> {} mm",
                                         d.validation_method,
                                         Millimetres(d.rms_test_before),
                                         Millimetres(d.rms_test_after));
  if (std::isnan(d.rms_train_before)) {
    return "\n" + Wrap("  ", fmt::format("Complete geometry: RMS {}.", unseen));
  }
  return "\n" + Wrap("  ",
                     fmt::format("All physics together: RMS on fitted rows {} -> {} mm; {}.",
                                 Millimetres(d.rms_train_before),
                                 Millimetres(d.rms_train_after),
                                 unseen));
}

}  // namespace

std::string DiagnosisSection(const ProblemSpec& spec, const Result& result) {
  if (!result.diagnosis) return "";
  const DiagnosisResult& d = *result.diagnosis;
  std::string text = Heading("LEFT-OUT PHYSICS: " + Upper(ToString(d.verdict)));
  text += Wrap("  ", fmt::format("In short: {}.", d.summary));
  text += MisfitWords(d);
  for (std::size_t k = 0; k < d.findings.size(); ++k) {
    text += FindingWords(spec.robot, k + 1, d.findings[k]);
  }
  text += TogetherWords(d) + RestWords(spec.robot, d) + MovedTable(d);
  if (d.misfit.p_value <= d.false_alarm) text += MapTable(d);
  text += HiddenTable(d);
  std::vector<std::string> untested;
  for (const NotTestable& entry : d.not_testable) {
    if (untested.size() == kMostNotTestable) break;
    untested.push_back(entry.effect + " (" + entry.reason + ")");
  }
  if (!untested.empty()) {
    text += "\n" + Wrap("  Not testable here: ", fmt::format("{}.", fmt::join(untested, "; ")));
  }
  for (const std::string& note : d.notes) text += Wrap("  - ", note);
  return text;
}

}  // namespace dhcal
