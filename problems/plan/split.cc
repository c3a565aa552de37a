#include "problems/plan/split.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/rng.h"
#include "core/physics/effect.h"
#include "core/physics/registry.h"
#include "problems/assembly.h"
#include "problems/fit.h"
#include "problems/noise.h"
#include "problems/plan/candidates.h"
#include "problems/plan/information.h"
#include "problems/plan/plan_space.h"
#include "problems/start.h"

namespace dhcal {
namespace {

// Pairs of the likeliest are enough: each more costs its square.
constexpr std::size_t kMostAlternatives = 6;
// An effect may be as large as it likes: this only keeps what no reading shows from being singular.
constexpr double kNextToNothing = 1e-6;

/// True where a pose can choose what decides the effect.
bool CanBeSteered(const EffectRequest& effect, const Recording& own) {
  const Effect& known = *FindEffect(effect.effect);
  return known.DependsOnPoseOnly(effect) || effect.effect == "backlash" ||
         (effect.effect == "link_thermal" && own.temperature.rows() > 0);
}

std::vector<Alternative> Steerable(const std::vector<Alternative>& alternatives,
                                   const Recording& own,
                                   std::vector<std::string>* notes) {
  std::vector<Alternative> kept;
  for (const Alternative& alternative : alternatives) {
    const bool steered =
        std::all_of(alternative.begin(), alternative.end(), [&](const EffectRequest& effect) {
          return CanBeSteered(effect, own);
        });
    if (steered && kept.size() < kMostAlternatives) {
      kept.push_back(alternative);
    } else {
      notes->push_back(
          fmt::format("Left out: {}{}.",
                      AlternativeName(alternative),
                      steered ? ", less likely" : ", which no choice of poses can steer"));
    }
  }
  return kept;
}

/// Gives the rows what effects depend on beside the joints, at random: both approaches, payloads
/// and temperatures that the recording has.
void AddCircumstances(const std::vector<Alternative>& alternatives,
                      const Recording& own,
                      Rng* rng,
                      Recording* rows) {
  const auto any = [&](const char* name) {
    return std::any_of(alternatives.begin(), alternatives.end(), [&](const Alternative& a) {
      return std::any_of(
          a.begin(), a.end(), [&](const EffectRequest& e) { return e.effect == name; });
    });
  };
  const Eigen::Index count = rows->q.rows();
  const auto drawn_row = [&] {
    return std::min<Eigen::Index>(
        static_cast<Eigen::Index>(rng->Uniform(0, static_cast<double>(own.q.rows()))),
        own.q.rows() - 1);
  };
  if (any("backlash")) {
    rows->direction.resize(count, rows->q.cols());
    for (double& way : rows->direction.reshaped()) way = rng->Uniform(0, 1) < 0.5 ? -1 : 1;
  }
  if (own.payload.size() > 0) {
    rows->payload.resize(count);
    for (double& payload : rows->payload) payload = own.payload[drawn_row()];
  }
  if (own.temperature.rows() > 0 && any("link_thermal")) {
    rows->temperature.resize(count, own.temperature.cols());
    for (Eigen::Index row = 0; row < count; ++row) {
      rows->temperature.row(row) = own.temperature.row(drawn_row());
    }
  }
}

/// The problem with all the alternatives' effects, each once.
ProblemSpec WithAll(const ProblemSpec& spec, const std::vector<Alternative>& alternatives) {
  ProblemSpec all = spec;
  std::vector<EffectRequest>& effects = all.parameters.effects;
  for (const Alternative& alternative : alternatives) {
    for (const EffectRequest& effect : alternative) {
      const bool known = std::any_of(
          effects.begin(), effects.end(), [&](const EffectRequest& e) { return e.SameAs(effect); });
      if (known) continue;
      effects.push_back(effect);
      effects.back().held = false;
      effects.back().values.clear();
    }
  }
  return all;
}

/// An alternative among the columns of all, in units of their tolerances.
struct Signature {
  Eigen::VectorXd values;      // as the recording shows them; 0 for columns of others
  std::vector<int> absorbing;  // geometry and own columns
  std::vector<double> known;   // of each of them, what is known beforehand: 1 = its tolerance
};

/// Parameter values by a fit of the recording with this alternative; nothing where it has none.
std::optional<Signature> SignatureOf(const ProblemSpec& spec,
                                     const Recording& own,
                                     const Alternative& alternative,
                                     const std::vector<std::string>& names,
                                     Noise* noise) {
  const ProblemSpec with = WithAll(spec, {alternative});
  Calibration c(with, own);
  AlignStart(&c);
  FitFramesAlone(&c, {});
  const Fit fit = RunBentFit(SettingsOf(c), &c);
  if (!fit.summary.IsSolutionUsable()) return std::nullopt;
  noise->sigma = std::min(noise->sigma, fit.noise_seen.sigma);
  noise->sigma_rotation = std::min(noise->sigma_rotation, fit.noise_seen.sigma_rotation);
  Signature signature;
  signature.values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size()));
  const Eigen::VectorXd tolerance = ScalesOf(c.parameters).tolerance;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto found = std::find_if(c.parameters.begin(),
                                    c.parameters.end(),
                                    [&](const Parameter& p) { return p.name == names[k]; });
    if (found == c.parameters.end()) continue;
    signature.absorbing.push_back(static_cast<int>(k));
    const auto at = found - c.parameters.begin();
    const bool of_effect = found->effect_column >= 0;
    signature.known.push_back(of_effect ? kNextToNothing : 1.0);
    if (of_effect) {
      signature.values[static_cast<Eigen::Index>(k)] = fit.summary.state[at] / tolerance[at];
    }
  }
  return signature;
}

/// s_ab^2 by this information.
double SquaredDistance(const Eigen::MatrixXd& information, const Signature& a, const Signature& b) {
  const auto size = static_cast<Eigen::Index>(b.absorbing.size());
  Eigen::MatrixXd absorbing(size, size);
  Eigen::VectorXd seen(size);
  const Eigen::VectorXd whole = information * a.values;
  for (Eigen::Index i = 0; i < size; ++i) {
    const int row = b.absorbing[static_cast<std::size_t>(i)];
    seen[i] = whole[row];
    for (Eigen::Index j = 0; j < size; ++j) {
      absorbing(i, j) = information(row, b.absorbing[static_cast<std::size_t>(j)]);
    }
    absorbing(i, i) += b.known[static_cast<std::size_t>(i)];
  }
  return std::max(0.0, a.values.dot(whole) - seen.dot(absorbing.llt().solve(seen)));
}

/// Chances that pairs stay together, summed.
double Confusion(const Eigen::MatrixXd& information, const std::vector<Signature>& signatures) {
  double sum = 0;
  for (std::size_t a = 0; a < signatures.size(); ++a) {
    for (std::size_t b = 0; b < signatures.size(); ++b) {
      if (a == b) continue;
      sum += std::exp(-SquaredDistance(information, signatures[a], signatures[b]) / 2);
    }
  }
  return sum;
}

std::vector<SplitPair> PairsOf(const std::vector<std::string>& alternatives,
                               const std::vector<Signature>& signatures,
                               const Eigen::MatrixXd& before,
                               const Eigen::MatrixXd& after) {
  std::vector<SplitPair> pairs;
  for (std::size_t a = 0; a < signatures.size(); ++a) {
    for (std::size_t b = 0; b < signatures.size(); ++b) {
      if (a == b) continue;
      pairs.push_back({alternatives[a],
                       alternatives[b],
                       std::sqrt(SquaredDistance(before, signatures[a], signatures[b])),
                       std::sqrt(SquaredDistance(after, signatures[a], signatures[b]))});
    }
  }
  return pairs;
}

/// The chosen rows with their circumstances.
Recording Picked(const Recording& rows, const std::vector<int>& chosen) {
  const auto pick = [&](const Eigen::MatrixXd& from) {
    if (from.rows() == 0) return Eigen::MatrixXd();
    Eigen::MatrixXd to(static_cast<Eigen::Index>(chosen.size()), from.cols());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      to.row(static_cast<Eigen::Index>(k)) = from.row(chosen[k]);
    }
    return to;
  };
  Recording picked;
  picked.q = pick(rows.q);
  picked.direction = pick(rows.direction);
  picked.temperature = pick(rows.temperature);
  if (rows.payload.size() > 0) picked.payload = pick(rows.payload);
  return picked;
}

/// The problem of the candidates' readings, with effects as they are.
ProblemSpec CandidateProblem(const ProblemSpec& all, std::vector<std::string>* notes) {
  ProblemSpec planning = all;
  planning.parameters.effects.clear();
  planning = PlanningProblem(planning, notes);
  planning.parameters.effects = all.parameters.effects;
  return planning;
}

/// Greedy: one pose after the other.
std::vector<int> ChooseSplitting(const std::vector<Eigen::MatrixXd>& informations,
                                 const std::vector<Signature>& signatures,
                                 int count,
                                 Eigen::MatrixXd* information) {
  std::vector<int> chosen;
  while (static_cast<int>(chosen.size()) < count && chosen.size() < informations.size()) {
    int best = -1;
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < informations.size(); ++k) {
      if (std::find(chosen.begin(), chosen.end(), static_cast<int>(k)) != chosen.end()) continue;
      const double confusion = Confusion(*information + informations[k], signatures);
      if (confusion < least) {
        least = confusion;
        best = static_cast<int>(k);
      }
    }
    if (best < 0) break;
    *information += informations[static_cast<std::size_t>(best)];
    chosen.push_back(best);
  }
  return chosen;
}

}  // namespace

std::vector<Alternative> AlternativesOf(const std::vector<HypothesisResult>& hypotheses) {
  std::vector<Alternative> alternatives;
  for (const HypothesisResult& hypothesis : hypotheses) {
    const bool named = std::all_of(
        hypothesis.effects.begin(), hypothesis.effects.end(), [](const EffectRequest& effect) {
          return FindEffect(effect.effect) != nullptr;
        });
    if (hypothesis.kept && named && !hypothesis.effects.empty()) {
      alternatives.push_back(hypothesis.effects);
    }
  }
  return alternatives;
}

std::string AlternativeName(const Alternative& alternative) {
  std::vector<std::string> names;
  names.reserve(alternative.size());
  for (const EffectRequest& effect : alternative) names.push_back(InstanceName(effect));
  return fmt::format("{}", fmt::join(names, " + "));
}

std::optional<SplitPlan> PlanSplit(const ProblemSpec& spec,
                                   const Recording& own,
                                   const std::vector<Alternative>& alternatives,
                                   const SplitOptions& options,
                                   Diagnostics* diagnostics) {
  SplitPlan plan;
  if (spec.measurement.kind.edges) {
    diagnostics->Error(spec.measurement.where,
                       "splitting poses are planned for free poses, not along straight edges");
    return std::nullopt;
  }
  const std::vector<Alternative> steerable = Steerable(alternatives, own, &plan.notes);
  if (steerable.size() < 2) {
    diagnostics->Error({spec.file},
                       fmt::format("{} of the alternatives depend on what poses can choose, so "
                                   "there is nothing to split; two are needed",
                                   steerable.size()));
    return std::nullopt;
  }
  const ProblemSpec all = WithAll(spec, steerable);
  Rng rng(options.seed);
  Candidates drawn = DrawPoses(spec.robot, options.volume, options.candidates, &rng);
  AddCircumstances(steerable, own, &rng, &drawn.rows);
  const ProblemSpec planning = CandidateProblem(all, &plan.notes);
  ProblemSpec reading = planning;
  reading.parameters.effects.clear();
  const std::optional<Recording> rows = ReadingsAt(reading, drawn.rows, diagnostics);
  if (!rows || drawn.count < options.count) {
    diagnostics->Error({spec.file}, "the robot reaches too few poses in the volume");
    return std::nullopt;
  }

  Calibration c_own(all, own);
  AlignStart(&c_own);
  const Calibration c_rows(planning, *rows);
  std::vector<std::string> names;
  for (const Parameter& p : c_own.parameters) names.push_back(p.name);
  for (const Parameter& p : c_rows.parameters) {
    if (std::find(names.begin(), names.end(), p.name) == names.end()) names.push_back(p.name);
  }
  Noise noise{HUGE_VAL, HUGE_VAL};
  std::vector<Signature> signatures;
  for (const Alternative& alternative : steerable) {
    std::optional<Signature> signature = SignatureOf(spec, own, alternative, names, &noise);
    if (!signature) continue;
    signatures.push_back(std::move(*signature));
    plan.alternatives.push_back(AlternativeName(alternative));
  }
  const RowGroups one{std::vector<int>(static_cast<std::size_t>(own.num_rows()), 0), 1};
  const Eigen::MatrixXd before = InformationOf(c_own, noise, names, one).front();
  const int per_pose = rows->num_rows() / drawn.count;
  RowGroups groups{{}, drawn.count};
  for (int row = 0; row < rows->num_rows(); ++row) groups.of_row.push_back(row / per_pose);
  const std::vector<Eigen::MatrixXd> informations = InformationOf(c_rows, noise, names, groups);
  Eigen::MatrixXd after = before;
  const std::vector<int> chosen = ChooseSplitting(informations, signatures, options.count, &after);
  plan.rows = Picked(drawn.rows, chosen);
  plan.pairs = PairsOf(plan.alternatives, signatures, before, after);
  return plan;
}

}  // namespace dhcal
