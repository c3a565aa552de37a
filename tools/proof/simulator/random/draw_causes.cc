#include "tools/proof/simulator/random/draw_causes.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tools/proof/simulator/causes.h"
#include "tools/proof/simulator/random/cause_sources.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

constexpr double kWeakest = 0.5, kStrongest = 30;  // usual sizes
constexpr double kNothingLeftOut = 0.2, kOutside = 0.12, kOutsideAlone = 0.6;

std::vector<CauseSource> Possible(std::vector<CauseSource> sources) {
  sources.erase(std::remove_if(sources.begin(),
                               sources.end(),
                               [](const CauseSource& source) { return !source.possible; }),
                sources.end());
  return sources;
}

void Append(std::vector<CauseSource> more, std::vector<CauseSource>* sources) {
  for (CauseSource& source : more) sources->push_back(std::move(source));
}

std::vector<Cause> DrawOne(const std::vector<CauseSource>& sources,
                           const Subject& subject,
                           Rng* rng) {
  std::vector<double> weights;
  for (const CauseSource& source : sources) weights.push_back(source.weight);
  const CauseSource& source = sources[DrawIndex(weights, rng)];
  return source.draw(subject, DrawLogUniform(kWeakest, kStrongest, rng), rng);
}

/// One name at one place once: two gears of a joint, or two instants of a step, would be told apart
/// by settings, which are not scored.
bool IsNew(const Cause& cause, const std::vector<Cause>& causes) {
  return std::none_of(causes.begin(), causes.end(), [&](const Cause& other) {
    return cause.effect == other.effect && cause.joint == other.joint;
  });
}

/// The file must have the columns that a person would have recorded with such a cause in mind.
void ProvideColumns(const std::vector<Cause>& causes, Settings* settings) {
  for (const Cause& cause : causes) {
    if (cause.effect_class == "C5") settings->clock = true;
  }
}

/// The instrument stands elsewhere in each run.
Cause ForgottenSetups(int runs, double strength, Rng* rng) {
  std::vector<Move> moves;
  for (int run = 0; run < runs; ++run) {
    moves.push_back({strength * 1e-4 * DrawDirection(rng), strength * 0.5e-4 * DrawDirection(rng)});
  }
  Cause cause = BaseMovesBetweenRuns(moves);
  // With two runs it is one step; what is common to them is the place of the base.
  cause.also = {"base_step"};
  return cause;
}

}  // namespace

void DrawCauses(RandomTrial* trial, Rng* rng) {
  const Settings& s = trial->settings;
  const double strength = DrawLogUniform(kWeakest, kStrongest, rng);
  if (s.setups == Setups::kForgotten) {
    trial->causes.push_back(ForgottenSetups(s.runs, strength, rng));
  }
  if (Chance(kNothingLeftOut, rng)) return;
  const Subject subject(*trial);
  std::vector<CauseSource> library = SourcesOfLoads(subject);
  Append(SourcesOfJoints(subject), &library);
  Append(SourcesInTime(subject), &library);
  library = Possible(library);
  std::size_t wanted = 1 + DrawIndex({0.55, 0.28, 0.17}, rng);
  std::vector<Cause> causes;
  if (Chance(kOutside, rng)) {
    causes = DrawOne(Possible(SourcesOutside(subject)), subject, rng);
    wanted = Chance(kOutsideAlone, rng) ? 1 : 2;
  }
  while (causes.size() < wanted) {
    for (const Cause& cause : DrawOne(library, subject, rng)) {
      if (IsNew(cause, causes)) causes.push_back(cause);
    }
  }
  for (Cause& cause : causes) trial->causes.push_back(std::move(cause));
  ProvideColumns(trial->causes, &trial->settings);
}

}  // namespace dhcal::concealed
