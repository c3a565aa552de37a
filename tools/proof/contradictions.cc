#include "tools/proof/contradictions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/proof/json_numbers.h"

namespace dhcal {
namespace {

using Json = nlohmann::json;
using Sentences = std::vector<std::string>;

constexpr double kLeastCertain = 1.96;  // deviations that one value of a finding differs from zero

bool HasAlternatives(const Json& finding) { return !finding.at("confusable_with").empty(); }

bool IsOutsideOne(double p) { return p < 0 || p > 1; }

void LookAtParameter(const Json& parameter, const std::string& name, Sentences* wrong) {
  if (!parameter.contains("value") || !parameter.contains("ci95")) return;
  const double value = parameter.at("value").get<double>();
  const Json& interval = parameter.at("ci95");
  if (interval[0].get<double>() > value || interval[1].get<double>() < value) {
    wrong->push_back(name + ": an interval does not hold its value");
  }
}

void LookAtFinding(const Json& finding, double false_alarm, Sentences* wrong) {
  const std::string name = finding.at("effect").get<std::string>();
  const double p = NumberOr(finding, "p_value", 0);
  if (IsOutsideOne(p)) wrong->push_back(name + ": its p is no probability");
  if (p > false_alarm) wrong->push_back(name + ": found at a p above the rate of false alarms");
  double surest = 0;
  for (const Json& parameter : finding.at("parameters")) {
    LookAtParameter(parameter, name, wrong);
    const double sigma = NumberOr(parameter, "sigma", 0);
    if (sigma > 0) surest = std::max(surest, std::abs(NumberOr(parameter, "value", 0)) / sigma);
  }
  if (!finding.at("parameters").empty() && surest < kLeastCertain) {
    wrong->push_back(name + ": no value differs from zero by two deviations");
  }
  for (const Json& caution : finding.at("cautions")) {
    const std::string text = caution.get<std::string>();
    if (text.find("negative") != std::string::npos ||
        text.find("times its usual size") != std::string::npos) {
      wrong->push_back(fmt::format("{}: {}", name, text));
    }
  }
}

void LookAtVerdict(const Json& d, Sentences* wrong) {
  const std::string verdict = d.at("verdict");
  const Json& findings = d.at("findings");
  const bool rest = d.contains("unexplained");
  const bool alternatives = std::any_of(findings.begin(), findings.end(), HasAlternatives);
  const bool physics = std::any_of(findings.begin(), findings.end(), [](const Json& finding) {
    return finding.at("class") != "geometry";
  });
  const auto say = [&](bool breaks, const char* what) {
    if (breaks) wrong->push_back(fmt::format("{}: {}", verdict, what));
  };
  if (verdict == "consistent") {
    say(!findings.empty(), "but there are findings");
    say(rest, "but something is unexplained");
    say(NumberOr(d.at("misfit"), "p_value", 1) < NumberOr(d, "false_alarm", 0), "at a small p");
  } else if (verdict == "explained") {
    say(findings.empty(), "but there is no finding");
    say(alternatives, "but a finding has alternatives");
    say(rest, "but something is unexplained");
  } else if (verdict == "partly_explained") {
    say(!physics, "but no physics is found");
    say(!rest, "but nothing is unexplained");
  } else if (verdict == "ambiguous") {
    say(!alternatives, "but no finding has an alternative");
  } else {
    say(verdict == "unexplained" && physics, "but physics is found");
    say(verdict == "failed" && !findings.empty(), "but there are findings");
  }
}

void LookAtTotals(const Json& d, Sentences* wrong) {
  const Json& misfit = d.at("misfit");
  const auto listed = static_cast<double>(misfit.at("outlier_rows").size());
  if (NumberOr(misfit, "outliers", listed) != listed) {
    wrong->push_back("rows set aside: not as many as are listed");
  }
  if (IsOutsideOne(NumberOr(misfit, "p_value", 0))) wrong->push_back("misfit: p is no probability");
  if (d.at("findings").empty() && !d.at("moved_parameters").empty()) {
    wrong->push_back("parameters moved by something without findings");
  }
  if (!d.contains("unexplained")) return;
  const double fraction = NumberOr(d.at("unexplained"), "fraction", -1);
  if (fraction <= 0 || fraction > 1) {
    wrong->push_back(fmt::format("unexplained: a fraction of {:.3g}", fraction));
  }
}

}  // namespace

std::vector<std::string> ContradictionsIn(const Json& diagnosis) {
  Sentences wrong;
  const double false_alarm = NumberOr(diagnosis, "false_alarm", 0.01);
  for (const Json& finding : diagnosis.at("findings")) LookAtFinding(finding, false_alarm, &wrong);
  LookAtVerdict(diagnosis, &wrong);
  LookAtTotals(diagnosis, &wrong);
  return wrong;
}

}  // namespace dhcal
