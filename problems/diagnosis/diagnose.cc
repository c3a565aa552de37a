#include "problems/diagnosis/diagnose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/math/statistics.h"
#include "core/physics/registry.h"
#include "problems/diagnosis/judge/certainty.h"
#include "problems/diagnosis/judge/conclude.h"
#include "problems/diagnosis/judge/describe.h"
#include "problems/diagnosis/judge/doubtful.h"
#include "problems/diagnosis/judge/hidden.h"
#include "problems/diagnosis/judge/misfit.h"
#include "problems/diagnosis/judge/moved_readings.h"
#include "problems/diagnosis/judge/rest.h"
#include "problems/diagnosis/judge/unseen_rows.h"
#include "problems/diagnosis/loop.h"
#include "problems/diagnosis/loop_inputs.h"
#include "problems/diagnosis/rows/outliers.h"
#include "problems/diagnosis/rows/repeats.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a joint's readings say of its last motion, in the controller's sense; zeros without rows.
MatrixXd DirectionsOf(const ProblemSpec& spec, const Recording& recording) {
  const PhysicsContext context(spec.robot, recording, {spec.robot.X_WB});
  MatrixXd direction = context.direction();
  for (Index joint = 0; joint < direction.cols(); ++joint) {
    direction.col(joint) *= context.sign(static_cast<int>(joint));
  }
  return direction;
}

// What stated masses leave, of what fitted ones do, before the fitted ones are delivered.
constexpr double kClearlyMore = 1.02;

/// Takes members out that rows not fitted speak against, the most harmful first, fitting again.
void TakeBack(const JointModel& model, const Loop& loop, LoopOutcome* outcome, DiagnosisResult* d) {
  while (true) {
    const std::vector<std::vector<int>> groups = FindingGroups(outcome->fit.state.members);
    if (groups.empty()) return;
    const UnseenRows unseen(model, outcome->fit, loop.Choice(), loop.GoodReadings(true));
    const std::vector<int>* worst = nullptr;
    double least = 0;
    for (const std::vector<int>& group : groups) {
      if (!unseen.SpeakAgainst(group)) continue;
      const double sum = unseen.GainOf(group, 0).sum;
      if (worst != nullptr && sum >= least) continue;
      worst = &group;
      least = sum;
    }
    if (worst == nullptr) return;
    JointState state = outcome->fit.state;
    for (auto m = worst->rbegin(); m != worst->rend(); ++m) {
      d->notes.push_back(fmt::format(
          "{} fits the rows but does not help to predict rows left out; it was withdrawn.",
          InstanceName(state.members[static_cast<std::size_t>(*m)].item.request)));
      state.members.erase(state.members.begin() + *m);
    }
    outcome->fit = FitJointly(model, state, loop.Choice(), outcome->free, 3);
  }
}

/// Takes the names off that something unnamed makes doubtful.
void TakeNamesOff(LoopOutcome* outcome, DiagnosisResult* d) {
  std::vector<Member>& members = outcome->fit.state.members;
  for (const int m : DoubtfulMembers(outcome->fit)) {
    Item& item = members[static_cast<std::size_t>(m)].item;
    d->notes.push_back(fmt::format(
        "{} would fit, but is not named: it may be a part of something else that joint {} does and "
        "that has no name.",
        InstanceName(item.request),
        item.request.joint));
    item = Unnamed(item, *outcome->fit.context);
  }
}

/// `fit`: the rows of the bank. Without a structure and without cells no place is named.
void AddUnexplained(const Bank& bank,
                    const JointRows& fit,
                    const EvidenceRule& rule,
                    const Structure& structure,
                    DiagnosisResult* d) {
  // The largest unnamed part: a cell of the model itself, else the strongest of what is left.
  const Item* item =
      structure.item < 0 ? nullptr : &bank.items()[static_cast<std::size_t>(structure.item)];
  double largest = 0;
  for (const int m : CellMembers(fit.state.members)) {
    const Member& member = fit.state.members[static_cast<std::size_t>(m)];
    const int first = fit.FirstColumn(static_cast<std::size_t>(m));
    const double moved = (fit.X.middleCols(first, member.item.size) * member.value).norm();
    if (moved <= largest) continue;
    largest = moved;
    item = &member.item;
  }
  d->unexplained.emplace();
  if (item != nullptr) {
    d->unexplained = DescribeRest(*item, fit, structure.rest, std::sqrt(RowVariance(fit, rule)));
  }
  const auto rows = static_cast<double>(fit.y().size());
  const double sigma = d->misfit.noise_sigma;
  const double unnamed = sigma * sigma * std::max(structure.gain, largest * largest) / rows;
  const double before = d->rms_train_before * d->rms_train_before - sigma * sigma;
  const double after = d->rms_train_after * d->rms_train_after - sigma * sigma;
  const double left = after > 0 ? after : unnamed;
  d->unexplained->rms = std::sqrt(left);
  d->unexplained->fraction = before > left ? left / before : 1.0;
}

void AddHypotheses(const LoopOutcome& outcome, DiagnosisResult* d) {
  for (const std::vector<Item>& set : outcome.listed) {
    HypothesisResult result;
    for (const Item& item : set) result.effects.push_back(NameOf(item));
    result.kept = true;
    d->hypotheses.push_back(result);
  }
}

bool NeedsWholeModel(const EffectRequest& request) {
  const Effect* const effect = FindEffect(request.effect);
  return effect != nullptr && effect->Describe().needs_whole_model;
}

/// All names but those that need a whole model.
std::vector<std::string> NamesOfParts() {
  std::vector<std::string> names;
  for (const Effect* const effect : AllEffects()) {
    if (!effect->Describe().needs_whole_model) names.push_back(effect->Describe().name);
  }
  return names;
}

struct Search {
  DiagnosisResult result;  // frames that the file conceals
  std::unique_ptr<Loop> loop;
  LoopOutcome outcome;
};

Search SearchEffects(const ProblemSpec& spec,
                     const JointModel& model,
                     const Result& identified,
                     bool averaged,
                     const Progress& progress) {
  Search search;
  const auto run = [&] {
    LoopInputs inputs = InputsOf(spec, model, averaged, search.result.findings);
    inputs.progress = progress;
    search.loop = std::make_unique<Loop>(inputs);
    search.outcome = search.loop->Run();
  };
  search.result = ConcealedFramesIn(spec, model, identified, progress);
  run();
  if (search.result.findings.empty() || search.outcome.fit.state.members.empty()) return search;
  // Strong physics bends the file's own parameters, too: beside it, frames are asked for again.
  DiagnosisResult beside =
      ConcealedFramesIn(WithEffectsHeld(spec, search.outcome.fit), model, {}, progress);
  if (beside.findings.size() == search.result.findings.size()) return search;
  search.result = std::move(beside);
  run();
  return search;
}

DiagnosisResult DiagnoseWith(const ProblemSpec& spec,
                             const Recording& recorded,
                             const Result& identified,
                             const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto say = [&](const std::string& text, double share) {
    if (progress) progress({"left-out physics: " + text, share});
  };
  const DistinctRows distinct = PutRepeatsTogether(recorded, DirectionsOf(spec, recorded));
  const Recording& recording = distinct.recording;
  const JointModel model(spec, recording);
  Search search = SearchEffects(spec, model, identified, distinct.averaged, progress);
  const Loop& loop = *search.loop;
  LoopOutcome& outcome = search.outcome;
  DiagnosisResult& d = search.result;
  d.false_alarm = spec.diagnosis.false_alarm;
  d.averaged = distinct.averaged;
  if (distinct.averaged) {
    d.notes.push_back(
        fmt::format("Poses were read several times: {} rows are {} draws, and were put together.",
                    recorded.num_rows(),
                    recording.num_rows()));
  }
  say("rows that were not fitted", kShareAtUnseen);
  TakeBack(model, loop, &outcome, &d);
  TakeNamesOff(&outcome, &d);
  AddNotesOnRows(loop, outcome, &d);

  // All good rows; the geometry alone by the same.
  const RowChoice choice = loop.Choice(true);
  const EvidenceRule searched_rule = outcome.rule;
  outcome.fit =
      loop.Eliminate(outcome.fit.state, outcome.geometry, choice, kFarSteps, &outcome.completions);
  outcome.free = WithUnknowns(outcome.geometry, outcome.completions);
  outcome.rule = loop.RuleAt(outcome.fit, outcome.free.size(), outcome.rule.names);
  const JointRows before = FitJointly(model, model.Start(), choice, outcome.free, kFarSteps);
  UnseenRows unseen_before(model, before, choice, loop.GoodReadings(true));
  const UnseenRows unseen(model, outcome.fit, choice, loop.GoodReadings(true));
  unseen_before.AnnounceAs(unseen);
  d.rms_train_before = unseen_before.FittedRms({});
  // What is announced is what has names.
  const std::vector<int> cells = CellMembers(outcome.fit.state.members);
  d.rms_train_after = unseen.FittedRms(cells);
  d.rms_test_before = unseen_before.UnseenRms({});
  d.rms_test_after = unseen.UnseenRms(cells);
  d.validation_method = unseen.method();
  DescribeMisfit(before, choice.readings.size(), outcome, distinct, &d);
  AddMisreadRepeats(recorded, distinct, &d.misfit);

  const JointRows searched_before = model.At(before.state, loop.Choice(), outcome.free);
  const JointRows searched = model.At(outcome.fit.state, loop.Choice(), outcome.free);
  const Bank bank_before(model, searched_before, loop.Items(before, true), outcome.free);
  const Structure first = StrongestStructure(bank_before, searched_rule, d.misfit.noise_sigma);
  const Bank bank(model, searched, loop.Items(outcome.fit, true), outcome.free);
  Structure last = StrongestStructure(bank, searched_rule, d.misfit.noise_sigma);
  // Of the geometry alone, by the strongest structure; names and structures share the rate.
  const auto family_wise = [](double log_p) {
    return std::min(1.0, std::exp(std::max(log_p, -690.0)) / (1 - kShareOfNames));
  };
  d.misfit.p_value = family_wise(first.log_p);
  d.map = first.map;

  Judged judged;
  judged.rest = family_wise(last.log_p) < spec.diagnosis.false_alarm;
  if (judged.rest) {
    d.misfit.p_value = std::min(d.misfit.p_value, family_wise(last.log_p));
  } else {
    last.item = -1;  // chance: it stands for nothing
  }
  const double variance = RobustVariance(outcome.fit.y(), outcome.fit.rows->coordinates());
  if (outcome.rule.sigma_known && variance > kTuning.restless) {
    judged.restless = std::sqrt(variance);
    d.misfit.p_value = std::min(d.misfit.p_value, ChiSquareTail(d.misfit.statistic, d.misfit.dof));
  } else if (outcome.rule.sigma_known) {
    judged.doubted = DoubtedNoise(outcome);
  }
  judged.cells = !cells.empty();
  judged.moved = !outcome.moved.empty();
  const std::vector<std::vector<int>> groups = FindingGroups(outcome.fit.state.members);
  const Certainties certainties =
      CertaintiesOf(model, outcome.fit, outcome.completions, outcome.rule);
  for (Finding& finding : DescribeCompletions(model, outcome, certainties)) {
    d.findings.push_back(std::move(finding));
  }
  for (Finding& finding : DescribeMembers(model, outcome, certainties, unseen, groups)) {
    d.findings.push_back(std::move(finding));
  }
  for (const Finding& finding : d.findings) {
    // A line of a gear is found by a scan, which is not among the structures above.
    if (finding.effect_class != "geometry") {
      d.misfit.p_value = std::min(d.misfit.p_value, finding.p_value / kShareOfNames);
    }
  }
  AddConfusables(model, outcome, &d);
  // What the file can put right comes before physics.
  std::stable_partition(d.findings.begin(), d.findings.end(), [](const Finding& finding) {
    return finding.effect_class == "geometry";
  });
  d.model = ModelOf(outcome, certainties);
  const auto& members = outcome.fit.state.members;
  const bool loaded = std::any_of(members.begin(), members.end(), [](const Member& m) {
    return m.item.elastic && m.item.request.setting("free_masses", 0) == 0;
  });
  if (!model.masses_given() ? loaded
                            : unseen.RmsOfStatedMasses(cells) > kClearlyMore * d.rms_train_after) {
    d.links = outcome.fit.robot->links;
  }
  for (const int unknown : outcome.free) {
    const Parameter& p = model.calibration().parameters[static_cast<std::size_t>(unknown)];
    d.geometry[p.name] = outcome.fit.state.geometry[unknown];
  }
  if (!groups.empty()) {
    d.moved = MovedByPhysics(model, outcome, certainties, before.state.geometry);
  }
  GiveVerdict(judged, &d);
  if (judged.rest || judged.cells || judged.restless > 0) {
    AddUnexplained(bank, searched, outcome.rule, last, &d);
  }
  if (judged.moved) AddMovedReadings(model, outcome, distinct, &d);
  AddHypotheses(outcome, &d);
  const PhysicsContext context(spec.robot, recording, {spec.robot.X_WB});
  AddNotTestable(spec, context, &d);
  say("what could stay hidden", kShareAtHidden);
  AddHiddenRisks(model, searched, outcome.rule, last.rest, &d);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(d);
}

}  // namespace

DiagnosisResult Diagnose(const ProblemSpec& spec,
                         const Recording& recorded,
                         const Result& identified,
                         const Progress& progress) {
  DiagnosisResult all = DiagnoseWith(spec, recorded, identified, progress);
  std::vector<std::string> doubtful;
  for (const Finding& finding : all.findings) {
    if (NeedsWholeModel(finding.effect)) doubtful.push_back(InstanceName(finding.effect));
  }
  // Who lists names asks for these.
  if (doubtful.empty() || !all.unexplained || !spec.diagnosis.effects.empty()) return all;
  ProblemSpec of_parts = spec;
  of_parts.diagnosis.effects = NamesOfParts();
  const Progress second_half = [&](ProgressStep step) {
    step.share = (1 + step.share) / 2;
    if (progress) progress(step);
  };
  DiagnosisResult parts = DiagnoseWith(of_parts, recorded, identified, second_half);
  if (parts.rms_test_after > kTuning.unmistakable * all.rms_test_after) return all;
  parts.seconds += all.seconds;
  parts.notes.push_back(fmt::format(
      "Not named, because something else is left that may go along with it, and because it does "
      "little for rows that were not fitted: {}.",
      fmt::join(doubtful, ", ")));
  return parts;
}

}  // namespace dhcal
