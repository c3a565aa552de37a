#include "core/report/answer.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/report/error_table.h"
#include "core/report/first_screen.h"
#include "core/report/format.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostNames = 12;

std::string ValidationWords(const Result& result) {
  const ValidationResult& unseen = DeliveredValidation(result);
  if (unseen.method.empty()) {
    return "Nothing was tested on rows that were not fitted, so nobody knows how well the result "
           "predicts other poses.";
  }
  const auto shown = [&](double rms) { return WithMillimetres(InSpace(result.kind, rms)); };
  const std::string rows = Counted(std::max(unseen.rows, 0), "row");
  return fmt::format("{}: {}, beside {} on fitted rows ({}).",
                     unseen.method == "set column"
                         ? fmt::format("Tested on {} that were never fitted", rows)
                         : fmt::format("Tested on {}, each predicted by a fit without it", rows),
                     shown(unseen.rms_test),
                     shown(unseen.rms_train),
                     ErrorName(result.kind));
}

/// Which numbers of the robot stand for themselves.
std::string ParameterWords(const FitResult& fit) {
  std::vector<std::string> doubtful;
  std::size_t all = 0;
  for (const ParameterResult& p : fit.parameters) {
    if (p.unit == Unit::kOther || p.verdict == Verdict::kFixed) continue;
    ++all;
    if (p.verdict != Verdict::kIdentified) doubtful.push_back(p.name);
  }
  if (all == 0) return "";
  if (doubtful.empty()) {
    return fmt::format("All {} numbers of the geometry are measured, each by itself.", all);
  }
  const std::size_t known = all - doubtful.size();
  const std::size_t more = doubtful.size() - std::min(doubtful.size(), kMostNames);
  doubtful.resize(doubtful.size() - more);
  return fmt::format(
      "Of {} numbers of the geometry {} are measured, each by itself. The others act only together "
      "at these poses, or hardly at all, and mean nothing one by one: {}{}. The error above does "
      "not suffer from that.",
      all,
      known,
      fmt::join(doubtful, ", "),
      more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string IntervalsInShort(IntervalVerdict intervals) {
  switch (intervals) {
    case IntervalVerdict::kHold:
      return "The 95 % intervals of the numbers that are measured hold.";
    case IntervalVerdict::kGeometryIncomplete:
      return "No interval holds: the geometry that the file estimates is not complete.";
    case IntervalVerdict::kModelMissesNoise:
      return "No interval holds: the model does not meet the noise of the readings, and what it "
             "leaves out has moved its numbers.";
  }
  return "";
}

Section TrustSection(const Result& result) {
  const FitResult& fit = *result.delivered_fit();
  List list;
  list.kind = List::Kind::kBullets;
  const auto say = [&](const std::string& text) {
    if (!text.empty()) list.items.push_back({text, "", {}});
  };
  say(ValidationWords(result));
  say(ParameterWords(fit));
  say(IntervalsInShort(result.delivered ? result.delivered->intervals : result.intervals));
  say("All this is of the joint positions that were recorded; beyond them the result is "
      "extrapolated.");
  return {"What can be trusted", {list}};
}

}  // namespace

std::vector<Section> AnswerOf(const Result& result) {
  std::vector<Section> sections = FirstScreenOf(result, "").sections;
  if (result.best() == nullptr || sections.empty()) return sections;
  // What to do next comes last.
  sections.insert(sections.end() - 1, TrustSection(result));
  return sections;
}

}  // namespace dhcal
