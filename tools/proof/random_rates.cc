#include "tools/proof/random_rates.h"

#include <algorithm>
#include <iterator>

#include "tools/proof/wilson.h"

namespace dhcal {
namespace {

RandomRate RateAtMost(const std::string& name,
                      const std::string& title,
                      const RandomScores& of,
                      const RandomCondition& holds,
                      double bar) {
  return {name, title, Count(of, holds), static_cast<int>(of.size()), bar, /*at_most=*/true};
}

RandomRate RateAtLeast(const std::string& name,
                       const std::string& title,
                       const RandomScores& of,
                       const RandomCondition& holds,
                       double bar) {
  RandomRate rate = RateAtMost(name, title, of, holds, bar);
  rate.at_most = false;
  return rate;
}

}  // namespace

RandomScores Those(const RandomScores& scores, const RandomCondition& in) {
  RandomScores some;
  std::copy_if(scores.begin(), scores.end(), std::back_inserter(some), [&](const auto* score) {
    return in(*score);
  });
  return some;
}

RandomScores Ended(const std::vector<RandomScore>& scores) {
  RandomScores some;
  for (const RandomScore& score : scores) {
    if (score.failure.empty()) some.push_back(&score);
  }
  return some;
}

int Count(const RandomScores& scores, const RandomCondition& holds) {
  return static_cast<int>(Those(scores, holds).size());
}

bool RandomRate::reached() const {
  if (trials == 0) return true;
  const double rate = static_cast<double>(hits) / trials;
  return at_most ? rate <= bar : rate >= bar;
}

std::vector<RandomRate> RandomRates(const std::vector<RandomScore>& scores) {
  RandomScores all;
  for (const RandomScore& score : scores) all.push_back(&score);
  const RandomScores ended = Ended(scores);
  const RandomScores judged = Those(ended, [](const auto& s) { return s.judged; });
  const RandomScores some = Those(ended, [](const auto& s) { return !s.null && !s.outside; });
  const RandomScores outside = Those(ended, [](const auto& s) { return s.outside; });
  const RandomScores null = Those(ended, [](const auto& s) { return s.null; });
  const auto wrong = [](const auto& s) { return s.wrong_single; };
  return {
      RateAtLeast(
          "right_or_listed",
          "right or listed, of detectable",
          judged,
          [](const auto& s) { return s.listed; },
          0.97),
      RateAtLeast(
          "right_alone",
          "right alone, of detectable",
          judged,
          [](const auto& s) { return s.alone; },
          0.90),
      RateAtMost("wrong_single", "wrong single name, library", some, wrong, 0.01),
      RateAtMost("wrong_outside", "wrong single name, outside the library", outside, wrong, 0.10),
      RateAtMost(
          "extra",
          "a name that is not there beside the truth",
          judged,
          [](const auto& s) { return s.extra; },
          0.015),
      RateAtMost(
          "geometry_extra",
          "geometry named that is as stated, or freed",
          ended,
          [](const auto& s) { return s.geometry_extra; },
          0.015),
      RateAtMost(
          "false_alarm",
          "false alarms where nothing is left out",
          null,
          [](const auto& s) { return s.false_alarm; },
          0.015),
      RateAtMost(
          "contradictions",
          "reports that contradict themselves",
          ended,
          [](const auto& s) { return !s.contradictions.empty(); },
          0),
      RateAtMost(
          "failures",
          "cases without a result",
          all,
          [](const auto& s) { return !s.failure.empty(); },
          0)};
}

nlohmann::ordered_json RandomRatesToJson(const std::vector<RandomRate>& rates) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const RandomRate& rate : rates) {
    const RateInterval interval = WilsonInterval(rate.hits, rate.trials);
    array.push_back({{"name", rate.name},
                     {"title", rate.title},
                     {"hits", rate.hits},
                     {"trials", rate.trials},
                     {"wilson95", {interval.low, interval.high}},
                     {"bar", rate.bar},
                     {"bar_is", rate.at_most ? "at most" : "at least"},
                     {"reached", rate.reached()}});
  }
  return array;
}

}  // namespace dhcal
