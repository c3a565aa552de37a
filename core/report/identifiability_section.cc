// What the readings cannot tell, in the names of the parameters.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/report/format.h"
#include "core/report/sections.h"

namespace dhcal {
namespace {

constexpr std::size_t kMostDirections = 16;
constexpr std::size_t kMostEntries = 8;  // of one direction
constexpr std::size_t kMostParameters = 40;
constexpr std::size_t kMostPartners = 6;    // of a confounded parameter
constexpr std::size_t kLargestValues = 16;  // of a long spectrum
constexpr std::size_t kSmallestValues = 24;

std::string RankSentence(const FitResult& fit) {
  if (fit.rank < 0 || fit.columns < 0) return "";
  const auto determined = fit.columns - static_cast<int>(fit.null_space.size());
  std::string text = fmt::format(
      "{} of {} independent combinations of the parameters are measured more closely than "
      "manufacture determines them, {} are not",
      determined,
      fit.columns,
      fit.columns - determined);
  if (fit.rank != determined) text += fmt::format("; the solver changed {}", fit.rank);
  if (fit.rank_numerical >= 0 && fit.rank_numerical != determined) {
    text += fmt::format("; {} change the readings at all", fit.rank_numerical);
  }
  return text + ".";
}

/// "+1 d2  -1 d3"
std::string DirectionText(const NullDirection& null_direction) {
  std::vector<std::string> terms;
  for (const NullDirection::Entry& entry : null_direction.direction) {
    if (terms.size() == kMostEntries) break;
    terms.push_back(fmt::format("{:+.3g} {}", entry.weight, entry.name));
  }
  const std::string text = fmt::format("Direction: {}", fmt::join(terms, "  "));
  const std::size_t total = null_direction.direction.size();
  return total > terms.size() ? text + " " + AndMore(total - terms.size()) : text;
}

/// True if a direction is a matter of curves' values only.
bool InCurvesOnly(const NullDirection& direction) {
  return std::all_of(direction.direction.begin(),
                     direction.direction.end(),
                     [](const NullDirection::Entry& e) { return !CurveOf(e.name).empty(); });
}

/// Of curves' values: a curve is told as one thing.
std::vector<NullDirection> WithoutCurves(const std::vector<NullDirection>& all) {
  std::vector<NullDirection> others;
  std::copy_if(all.begin(), all.end(), std::back_inserter(others), [](const NullDirection& d) {
    return !InCurvesOnly(d);
  });
  return others;
}

List NullSpaceList(const std::vector<NullDirection>& null_space) {
  List list;
  list.kind = List::Kind::kNumbers;
  for (std::size_t i = 0; i < null_space.size() && i < kMostDirections; ++i) {
    const bool repeated = i > 0 && null_space[i].explanation == null_space[i - 1].explanation;
    list.items.push_back({repeated ? "as before" : null_space[i].explanation,
                          "",
                          {{DirectionText(null_space[i]), "", {}}}});
  }
  list.left_out = null_space.size() - list.items.size();
  return list;
}

/// What is said of a parameter; a sentence that stands above is referred to by its number.
std::string ParameterText(const ParameterResult& parameter,
                          const std::vector<NullDirection>& null_space) {
  std::string text = fmt::format("{}, {}", parameter.name, ToString(parameter.verdict));
  const std::vector<std::string>& all = parameter.confounded_with;
  if (!all.empty()) {
    const auto end = all.begin() + static_cast<long>(std::min(all.size(), kMostPartners));
    text += fmt::format(" with {}", fmt::join(all.begin(), end, ", "));
    if (all.size() > kMostPartners) text += " " + AndMore(all.size() - kMostPartners);
  }
  if (parameter.explanation.empty()) return text;
  for (std::size_t k = 0; k < null_space.size() && k < kMostDirections; ++k) {
    if (null_space[k].explanation == parameter.explanation) {
      return text + fmt::format(" (see {})", k + 1);
    }
  }
  return text + ": " + parameter.explanation;
}

List DoubtfulParameters(const FitResult& fit, const std::vector<NullDirection>& null_space) {
  List list;
  list.kind = List::Kind::kBullets;
  list.title = "Parameters that cannot be trusted one by one:";
  for (const ParameterResult& parameter : fit.parameters) {
    if (parameter.verdict == Verdict::kIdentified || parameter.verdict == Verdict::kFixed) continue;
    if (!CurveOf(parameter.name).empty()) continue;
    if (list.items.size() < kMostParameters) {
      list.items.push_back({ParameterText(parameter, null_space), "", {}});
    } else {
      ++list.left_out;
    }
  }
  return list;
}

ListItem SingularValues(const FitResult& fit) {
  const std::vector<double>& all = fit.singular_values;
  const bool is_long = all.size() > kLargestValues + kSmallestValues + 1;
  std::vector<std::string> terms;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_long && i == kLargestValues) {
      const std::size_t left_out = all.size() - kLargestValues - kSmallestValues;
      terms.push_back(AndMore(left_out));
      i += left_out;
    }
    const bool cut = all[i] <= fit.truncation_cut;
    terms.push_back(cut ? fmt::format("[{:.2e}]", all[i]) : fmt::format("{:.2e}", all[i]));
  }
  std::string title = "Singular values";
  if (!fit.singular_values_of.empty()) title += " (" + fit.singular_values_of + ")";
  if (!std::isnan(fit.truncation_cut)) {
    title += fmt::format("; those in brackets, at or below {:.2e}, were set to zero",
                         fit.truncation_cut);
  }
  return {title + ":", "", {{fmt::format("{}", fmt::join(terms, " ")), "", {}}}};
}

/// What tells the quality of the poses in a few numbers.
List QualityNumbers(const FitResult& fit) {
  List list;
  const auto add = [&](const std::string& text) { list.items.push_back({text, "", {}}); };
  const ObservabilityIndices& o = fit.observability;
  if (!std::isnan(o.o1)) {
    add(fmt::format("Observability indices: O1 {:.3g}, O2 {:.3g}, O3 {:.3g}, O4 {:.3g}, O5 {:.3g}",
                    o.o1,
                    o.o2,
                    o.o3,
                    o.o4,
                    o.o5));
  }
  if (!std::isnan(fit.condition_number)) {
    add(fmt::format("Condition number of the directions kept: {:.3g}", fit.condition_number));
  }
  if (!fit.singular_values.empty()) list.items.push_back(SingularValues(fit));
  if (!fit.covariance_check.empty()) add(fit.covariance_check);
  return list;
}

/// The spectrum, and where it was cut. Values of exactly zero have no place on its axis.
Figure SpectrumFigure(const FitResult& fit) {
  Plot plot;
  plot.x = {"number", ""};
  plot.y = {"singular value", "", true};
  Plot::Series series;
  series.name = fit.singular_values_of;
  for (std::size_t i = 0; i < fit.singular_values.size(); ++i) {
    if (!(fit.singular_values[i] > 0)) continue;
    series.x.push_back(static_cast<double>(i + 1));
    series.y.push_back(fit.singular_values[i]);
  }
  if (series.x.empty()) return {};
  plot.series.push_back(series);
  if (fit.truncation_cut > 0) plot.levels.push_back({"cut", fit.truncation_cut});
  return {
      "Singular values in descending order; those at or below the cut were set to zero: what they "
      "stand for cannot be read off these poses.",
      {plot}};
}

}  // namespace

Section IdentifiabilitySection(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr) return {};
  Section section{"WHAT THIS DATA CANNOT DETERMINE", {}};
  const std::string rank = RankSentence(*fit);
  if (!rank.empty()) section.blocks.push_back(Paragraph{{rank}, ""});
  const std::vector<NullDirection> null_space = WithoutCurves(fit->null_space);
  for (const List& list : {NullSpaceList(null_space), DoubtfulParameters(*fit, null_space)}) {
    if (!list.items.empty()) section.blocks.push_back(list);
  }
  return section;
}

Section QualitySection(const Result& result) {
  const FitResult* const fit = result.delivered_fit();
  if (fit == nullptr) return {};
  Section section{"APPENDIX: QUALITY OF THE POSES", {}};
  const List numbers = QualityNumbers(*fit);
  if (!numbers.items.empty()) section.blocks.push_back(numbers);
  const Figure spectrum = SpectrumFigure(*fit);
  if (!spectrum.empty()) section.blocks.push_back(spectrum);
  return section;
}

}  // namespace dhcal
