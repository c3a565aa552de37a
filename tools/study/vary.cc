#include "tools/study/vary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/identify.h"
#include "tools/study/scenarios.h"

namespace dhcal {
namespace {

// What a reader takes from a diagnosis.
struct Answer {
  DiagnosisVerdict verdict = DiagnosisVerdict::kConsistent;
  std::vector<std::string> names;  // of what is left out, sorted
};

Answer AnswerTo(const Draw& draw) {
  const Result result = IdentifyGeometry(draw.spec, draw.recording, {});
  const DiagnosisResult diagnosis = Diagnose(draw.spec, draw.recording, result, {});
  Answer answer;
  answer.verdict = diagnosis.verdict;
  for (const Finding& finding : diagnosis.findings) {
    if (finding.effect_class != "geometry") answer.names.push_back(InstanceName(finding.effect));
  }
  std::sort(answer.names.begin(), answer.names.end());
  return answer;
}

std::vector<Answer> Answers(const std::vector<Draw>& draws) {
  std::vector<Answer> answers(draws.size());
  ParallelFor(static_cast<int>(draws.size()), [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    answers[at] = AnswerTo(draws[at]);
  });
  return answers;
}

struct Changes {
  int verdicts = 0;
  int names = 0;
};

Changes Between(const std::vector<Answer>& before, const std::vector<Answer>& after) {
  Changes changes;
  for (std::size_t k = 0; k < before.size(); ++k) {
    changes.verdicts += before[k].verdict != after[k].verdict ? 1 : 0;
    changes.names += before[k].names != after[k].names ? 1 : 0;
  }
  return changes;
}

// Puts the numbers back at the end of its life.
class NumbersInForce {
 public:
  NumbersInForce() : before_(kTuning) {}
  ~NumbersInForce() { internal::tuning_in_force = before_; }
  NumbersInForce(const NumbersInForce&) = delete;
  NumbersInForce& operator=(const NumbersInForce&) = delete;

  void Vary(const TuningNumber& number, double factor) {
    internal::tuning_in_force = Varied(before_, number, factor);
  }
  double Value(const TuningNumber& number) const {
    return number.real != nullptr ? before_.*number.real
                                  : static_cast<double>(before_.*number.count);
  }

 private:
  const Tuning before_;
};

}  // namespace

std::vector<TuningNumber> TuningNumbers() {
  const auto real = [](const char* name, double Tuning::*member) {
    return TuningNumber{name, member, nullptr};
  };
  const auto count = [](const char* name, int Tuning::*member) {
    return TuningNumber{name, nullptr, member};
  };
  return {real("outlier_sigmas", &Tuning::outlier_sigmas),
          real("most_outliers", &Tuning::most_outliers),
          real("repeats_share", &Tuning::repeats_share),
          real("overstated", &Tuning::overstated),
          real("overstated_p", &Tuning::overstated_p),
          real("noise_evidence", &Tuning::noise_evidence),
          count("most_searched", &Tuning::most_searched),
          count("start_blocks", &Tuning::start_blocks),
          real("start_p", &Tuning::start_p),
          real("prior_angle", &Tuning::prior_angle),
          real("prior_length", &Tuning::prior_length),
          real("prior_frame", &Tuning::prior_frame),
          real("mass_error", &Tuning::mass_error),
          real("centre_error", &Tuning::centre_error),
          real("guessed_mass", &Tuning::guessed_mass),
          real("guessed_centre", &Tuning::guessed_centre),
          count("beam", &Tuning::beam),
          count("most_members", &Tuning::most_members),
          count("rounds", &Tuning::rounds),
          real("size_decades", &Tuning::size_decades),
          real("largest_size", &Tuning::largest_size),
          real("unnamed_charge", &Tuning::unnamed_charge),
          real("list_margin", &Tuning::list_margin),
          count("longest_list", &Tuning::longest_list),
          real("restless", &Tuning::restless),
          real("predictive_bound", &Tuning::predictive_bound),
          real("unseen_errors", &Tuning::unseen_errors),
          real("unmistakable", &Tuning::unmistakable),
          real("shadow", &Tuning::shadow),
          real("least_certain", &Tuning::least_certain)};
}

Tuning Varied(Tuning tuning, const TuningNumber& number, double factor) {
  if (number.real != nullptr) {
    tuning.*number.real *= factor;
  } else {
    int& value = tuning.*number.count;
    value = std::max(1, static_cast<int>(std::lround(value * factor)));
  }
  return tuning;
}

void PrintVaried(int draws, std::ostream* out) {
  std::vector<Draw> cases;
  for (const Scenario& scenario : AllScenarios()) {
    for (int k = 0; k < draws; ++k) {
      cases.push_back(MakeDraw(scenario, static_cast<std::uint64_t>(k) + 1));
    }
  }
  const std::vector<Answer> before = Answers(cases);
  const auto asks = static_cast<int>(kShareThatAsks * static_cast<double>(cases.size()));
  *out << fmt::format(
      "{} recordings; of them verdicts | sets of names that change when a number is\n"
      "{:<20} {:>10}  {:>12}  {:>12}\n",
      cases.size(),
      "number",
      "now",
      "halved",
      "doubled");
  NumbersInForce numbers;
  for (const TuningNumber& number : TuningNumbers()) {
    numbers.Vary(number, 0.5);
    const Changes halved = Between(before, Answers(cases));
    numbers.Vary(number, 2);
    const Changes doubled = Between(before, Answers(cases));
    *out << fmt::format(
                "{:<20} {:>10.4g}  {:>5} | {:>4}  {:>5} | {:>4}{}\n",
                number.name,
                numbers.Value(number),
                halved.verdicts,
                halved.names,
                doubled.verdicts,
                doubled.names,
                std::max(halved.verdicts, doubled.verdicts) > asks ? "  needs a reason" : "")
         << std::flush;
  }
}

}  // namespace dhcal
