// The report's section on left-out physics.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/model/robot.h"
#include "core/physics/effect.h"
#include "core/report/error_table.h"
#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostOutliers = 30;
constexpr std::size_t kMostMap = 6;
constexpr std::size_t kMostConfusable = 6;
constexpr std::size_t kMostHidden = 8;
constexpr std::size_t kMostPoses = 4;
constexpr std::size_t kMostNotTestable = 12;
// Amounts at slots are printed in milliradians or millimetres, by the same factor.
constexpr double kMilli = 1e-3;  // [SI]

std::string Upper(std::string text) {
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::toupper(c));
  return text;
}

std::string Probability(double p) {
  if (std::isnan(p)) return "-";
  if (p < 1e-99) return "<1e-99";
  return p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.3f}", p);
}

/// "= 0.02", or "< 1e-99" as it is.
std::string Equals(const std::string& probability) {
  return probability[0] == '<' ? "< " + probability.substr(1) : "= " + probability;
}

/// How a quantity is printed.
struct ShownUnit {
  double size = 1;  // [SI]
  std::string name;
};

ShownUnit UnitOfJoint(const RobotModel& robot, int joint) {
  const bool slides = joint < robot.num_joints() &&
                      robot.joints[static_cast<std::size_t>(joint)].type == JointType::kPrismatic;
  return slides ? ShownUnit{kMillimetre, "mm"} : ShownUnit{kDegree, "deg"};
}

/// Of what drives a curve: angles and lengths as people read them off, the others as they stand.
ShownUnit UnitOfDriver(const std::string& si_unit) {
  if (si_unit == ToString(Unit::kRadian)) return {kDegree, "deg"};
  if (si_unit == ToString(Unit::kMetre)) return {kMillimetre, "mm"};
  return {1, si_unit};
}

/// A probability from draws says no more than that it is below the smallest they can give.
std::string Probability(double p, double floor) {
  const bool at_floor = std::abs(p - floor) <= 1e-9 * floor;
  return at_floor ? "< " + Probability(floor) : Probability(p);
}

/// "3, 17, 40 ... and 5 more".
std::string RowsInWords(const std::vector<int>& rows) {
  std::vector<std::string> words;
  for (const int row : rows) {
    if (words.size() == kMostOutliers) break;
    words.push_back(std::to_string(row + 1));
  }
  const std::size_t more = rows.size() - words.size();
  return fmt::format("{}{}", fmt::join(words, ", "), more > 0 ? " " + AndMore(more) : "");
}

Paragraph InShort(const MeasurementKind& kind, const DiagnosisResult& d) {
  Paragraph text{{Capitalised(d.summary) + "."}, ""};
  // Nothing was measured where the complete geometry has no fit; the summary says so.
  if (!d.answered()) return text;
  const Misfit& m = d.misfit;
  const std::string noise =
      m.noise_known
          ? fmt::format("the noise is {}", WithMillimetres(InSpace(kind, m.noise_sigma)))
          : fmt::format(
                "{} (the residuals suggest {}), so only their pattern speaks, not their size",
                m.why_estimated,
                WithMillimetres(InSpace(kind, m.noise_sigma)));
  std::string misfit = fmt::format(
      "The complete geometry alone leaves {} ({}, {} rows); {}. Probability that noise alone looks "
      "like this: {} (alarm below {:g}).",
      WithMillimetres(InSpace(kind, m.rms)),
      ErrorName(kind),
      m.rows,
      noise,
      Probability(m.p_value, m.p_floor),
      d.false_alarm);
  if (m.outliers > 0) {
    misfit +=
        fmt::format(" {} excluded: {}.", Counted(m.outliers, "row"), RowsInWords(m.outlier_rows));
  }
  text.lines.push_back(misfit);
  return text;
}

/// "" where it is not known.
std::string WithoutAndWith(const MeasurementKind& kind, const Finding& f) {
  if (std::isnan(f.rms_train_before)) return "";
  const auto shown = [&](double rms) { return WithMillimetres(InSpace(kind, rms)); };
  std::string text = fmt::format("Without this effect {}, with it {} ({}, fitted rows)",
                                 shown(f.rms_train_before),
                                 shown(f.rms_train_after),
                                 ErrorName(kind));
  if (!std::isnan(f.rms_test_before)) {
    text += fmt::format(
        "; {} and {} on rows not fitted", shown(f.rms_test_before), shown(f.rms_test_after));
  }
  return text + fmt::format(" (p {}).", Equals(Probability(f.p_value)));
}

/// "10.0, -20.0 deg"; with a prismatic joint each its own unit: "10.0 deg, 250.0 mm".
std::string PoseWords(const RobotModel& robot, const Eigen::VectorXd& q) {
  const bool all_turn =
      std::all_of(robot.joints.begin(), robot.joints.end(), [](const JointRow& row) {
        return row.type == JointType::kRevolute;
      });
  std::vector<std::string> joints;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const ShownUnit unit = UnitOfJoint(robot, static_cast<int>(k));
    joints.push_back(fmt::format("{:.1f}", q[k] / unit.size) +
                     (all_turn ? std::string() : fmt::format(" {}", unit.name)));
  }
  return fmt::format("{}{}", fmt::join(joints, ", "), all_turn ? " deg" : "");
}

std::string ConfusableWords(const std::vector<Confusable>& others) {
  std::vector<std::string> names;
  for (const Confusable& other : others) {
    if (names.size() == kMostConfusable) break;
    names.push_back(fmt::format("{} (likeness {:.2f})", InstanceName(other.effect), other.overlap));
  }
  const std::size_t more = others.size() - names.size();
  if (more > 0) names.push_back(AndMore(more));
  return fmt::format("{}.", fmt::join(names, "; "));
}

/// What to measure next to tell the finding from others; nothing when there is no such advice.
std::vector<ListItem> Advice(const RobotModel& robot, const Finding& f) {
  std::vector<ListItem> poses;
  for (const SeparatingPose& pose : f.separating_poses) {
    if (poses.size() == kMostPoses) break;
    poses.push_back({PoseWords(robot, pose.q), "pose:", {}});
  }
  if (f.separating_advice.empty()) return poses;
  return {{f.separating_advice + ".", "Measure next,", poses}};
}

ListItem FindingItem(const RobotModel& robot, const MeasurementKind& kind, const Finding& f) {
  const std::string driver =
      f.driver == "constant" ? "the same at all poses" : "driven by " + f.driver;
  ListItem item{Capitalised(f.sentence) + ".", "", {}};
  item.parts.push_back({fmt::format("Effect {}, {}.", InstanceName(f.effect), driver), "", {}});
  const std::string rms = WithoutAndWith(kind, f);
  if (!rms.empty()) item.parts.push_back({rms, "", {}});
  for (const std::string& caution : f.cautions) {
    item.parts.push_back({caution + ".", "Caution:", {}});
  }
  if (!f.confusable_with.empty()) {
    item.parts.push_back(
        {ConfusableWords(f.confusable_with), "These poses cannot distinguish it from:", {}});
  }
  for (const ListItem& advice : Advice(robot, f)) item.parts.push_back(advice);
  return item;
}

/// How all that was found does together, as far as it is known: where only geometry was found there
/// is no refit, and the numbers are of the file's own geometry and the complete one.
std::string TogetherWords(const MeasurementKind& kind, const DiagnosisResult& d) {
  if (std::isnan(d.rms_test_before)) return "";
  const auto shown = [&](double rms) { return WithMillimetres(InSpace(kind, rms)); };
  const std::string unseen = fmt::format("{} instead of {} on rows not fitted ({})",
                                         shown(d.rms_test_after),
                                         shown(d.rms_test_before),
                                         d.validation_method);
  if (std::isnan(d.rms_train_before)) {
    return fmt::format("Complete geometry: {} ({}).", unseen, ErrorName(kind));
  }
  return fmt::format("All together: {} instead of {} on fitted rows, {} ({}).",
                     shown(d.rms_train_after),
                     shown(d.rms_train_before),
                     unseen,
                     ErrorName(kind));
}

std::string RestWords(const MeasurementKind& kind, const Unexplained& rest) {
  const std::string place =
      rest.slot.empty()
          ? "no place stands out"
          : fmt::format("largest at {}, where it depends on {}", rest.slot, rest.driver);
  return fmt::format("{:.0f} % of the misfit ({}, {}); {}.",
                     100 * rest.fraction,
                     WithMillimetres(InSpace(kind, rest.rms)),
                     ErrorName(kind),
                     place);
}

Table CurveTable(const Unexplained& rest) {
  const char* const amount = rest.unit == Unit::kRadian ? "mrad" : "mm";
  const ShownUnit driver = UnitOfDriver(rest.driver_unit);
  Table table;
  table.columns = {{rest.driver, driver.name}, {rest.slot, amount}, {"+-", amount}};
  for (const CurvePoint& point : rest.curve) {
    table.AddRow({FixedWithin(point.driver_value / driver.size, 1, 10),
                  Fixed(point.amount / kMilli, 3),
                  Fixed(point.sigma / kMilli, 3)});
  }
  return table;
}

Figure CurveFigure(const Unexplained& rest) {
  const ShownUnit driver = UnitOfDriver(rest.driver_unit);
  Plot plot;
  plot.x = {rest.driver, driver.name};
  plot.y = {rest.slot, rest.unit == Unit::kRadian ? "mrad" : "mm"};
  Plot::Series series;
  series.name = "not explained";
  for (const CurvePoint& point : rest.curve) {
    series.x.push_back(point.driver_value / driver.size);
    series.y.push_back(point.amount / kMilli);
    series.sigma.push_back(point.sigma / kMilli);
  }
  plot.series = {series};
  return {
      fmt::format(
          "What is not explained, as a change of {} that depends on {}.", rest.slot, rest.driver),
      {plot}};
}

Table MovedTable(const std::vector<MovedParameter>& moved) {
  Table table;
  table.title = "Corrections of the geometry that the missing effects had biased";
  table.columns = {{"parameter", "", 20, Table::Align::kLeft},
                   {"without them", "mm, mrad"},
                   {"with them", "mm, mrad"},
                   {"+-", "mm, mrad"}};
  for (const MovedParameter& p : moved) {
    const int decimals = DecimalsOf(p.sigma / kMilli, 4);
    table.AddRow({p.name,
                  Fixed(p.before / kMilli, decimals),
                  Fixed(p.after / kMilli, decimals),
                  Fixed(p.sigma / kMilli, decimals)});
  }
  return table;
}

Table MapTable(const std::vector<MapEntry>& map) {
  Table table;
  table.columns = {{"where", "", 12, Table::Align::kLeft},
                   {"driven by", "", 34, Table::Align::kLeft},
                   {"statistic", ""},
                   {"freedom", ""},
                   {"p alone", ""},
                   {"size", "mm RMS"}};
  for (std::size_t k = 0; k < map.size() && k < kMostMap; ++k) {
    const MapEntry& entry = map[k];
    table.AddRow({entry.slot,
                  entry.driver,
                  Fixed(entry.statistic, 1),
                  Fixed(entry.dof, 0),
                  Probability(entry.p_value),
                  Millimetres(entry.rms)});
  }
  return table;
}

/// A limit that says something: a number, or that no size would be found (NaN, "never").
bool IsLimit(double limit) { return std::isnan(limit) || (std::isfinite(limit) && limit > 0); }

Table HiddenTable(const std::vector<HiddenRisk>& hidden) {
  Table table;
  table.title =
      "Effects that could still be hidden, and the error (3-D) that each could cause elsewhere "
      "(95 %, geometry refitted; joints within 120 deg around the recorded middle)";
  table.columns = {{"effect", "", 44, Table::Align::kLeft},
                   {"visible", "part"},
                   {"smallest found", ""},
                   {"unit", "", 22, Table::Align::kLeft},
                   {"error elsewhere", "mm"}};
  for (const HiddenRisk& risk : hidden) {
    if (table.rows.size() == kMostHidden) break;
    if (!IsLimit(risk.limit)) continue;
    table.AddRow({InstanceName(risk.effect),
                  Fixed(risk.visibility, 3),
                  std::isnan(risk.limit) ? "never" : Scientific(risk.limit, 1),
                  risk.unit,
                  std::isnan(risk.risk) ? "-" : Fixed(risk.risk / kMillimetre, 2)});
  }
  return table;
}

std::string NotTestableWords(const std::vector<NotTestable>& entries) {
  std::vector<std::string> words;
  for (const NotTestable& entry : entries) {
    if (words.size() == kMostNotTestable) break;
    words.push_back(entry.effect + " (" + entry.reason + ")");
  }
  return fmt::format("{}.", fmt::join(words, "; "));
}

/// What was found, and how far it goes.
std::vector<Block> Found(const RobotModel& robot,
                         const MeasurementKind& kind,
                         const DiagnosisResult& d) {
  std::vector<Block> blocks = {InShort(kind, d)};
  List findings;
  findings.kind = List::Kind::kNumbers;
  for (const Finding& finding : d.findings) {
    findings.items.push_back(FindingItem(robot, kind, finding));
  }
  if (!findings.items.empty()) blocks.emplace_back(findings);
  const std::string together = TogetherWords(kind, d);
  if (!together.empty()) blocks.emplace_back(Paragraph{{together}, ""});
  if (d.unexplained) {
    blocks.emplace_back(Paragraph{{RestWords(kind, *d.unexplained)}, "Not explained:"});
    if (!d.unexplained->curve.empty()) {
      blocks.emplace_back(CurveTable(*d.unexplained));
      blocks.emplace_back(CurveFigure(*d.unexplained));
    }
  }
  if (!d.moved.empty()) blocks.emplace_back(MovedTable(d.moved));
  return blocks;
}

/// What was looked at besides, and what could not be.
std::vector<Block> LookedAt(const DiagnosisResult& d) {
  std::vector<Block> blocks;
  const Table hidden = HiddenTable(d.hidden);
  if (!hidden.rows.empty()) blocks.emplace_back(hidden);
  if (!d.not_testable.empty()) {
    blocks.emplace_back(Paragraph{
        {"Could not be tested with this recording: " + NotTestableWords(d.not_testable)}, ""});
  }
  List notes;
  notes.kind = List::Kind::kBullets;
  for (const std::string& note : d.notes) notes.items.push_back({note, "", {}});
  if (!notes.items.empty()) blocks.emplace_back(notes);
  return blocks;
}

/// Why there is no diagnosis; a note says it where it had not ended.
Section NotLookedFor(const ProblemSpec& spec, const Result& result) {
  if (result.best() == nullptr) return {};
  std::string why;
  if (spec.diagnosis.run == DiagnosisRun::kNever) {
    why = "Not looked for: the problem file or --diagnosis says never.";
  } else if (result.noise_free) {
    why =
        "Not looked for: the residuals are smaller than any instrument's noise, so the recording "
        "is a simulation without noise and without left-out physics.";
  }
  return why.empty() ? Section() : Section{"UNMODELLED EFFECTS", {Paragraph{{why}, ""}}};
}

}  // namespace

Section MapSection(const Result& result) {
  if (!result.diagnosis) return {};
  const DiagnosisResult& d = *result.diagnosis;
  if (d.map.empty() || d.misfit.p_value > d.false_alarm) return {};
  return {"APPENDIX: MISMATCH MAP",
          {Paragraph{{"The strongest of all places and drivers, each alone, before any effect was "
                      "taken out; more of it is in result.json."},
                     ""},
           MapTable(d.map)}};
}

std::string DiagnosisTitle(const DiagnosisResult& diagnosis) {
  return "UNMODELLED EFFECTS: " + Upper(ToString(diagnosis.verdict));
}

Section DiagnosisSection(const ProblemSpec& spec, const Result& result) {
  if (!result.diagnosis) return NotLookedFor(spec, result);
  const DiagnosisResult& d = *result.diagnosis;
  Section section{DiagnosisTitle(d), Found(spec.robot, result.kind, d)};
  for (const Block& block : LookedAt(d)) section.blocks.push_back(block);
  return section;
}

}  // namespace dhcal
