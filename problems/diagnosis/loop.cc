#include "problems/diagnosis/loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glog/logging.h>

#include "core/physics/registry.h"
#include "core/physics/step.h"
#include "problems/diagnosis/hypotheses/cells.h"
#include "problems/diagnosis/hypotheses/time_constants.h"
#include "problems/diagnosis/judge/certainty.h"
#include "problems/diagnosis/rows/outliers.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/diagnosis/spectrum.h"
#include "problems/diagnosis/tuning.h"

namespace dhcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kInstantsAround = 12;  // rows to both sides
constexpr int kNearSteps = 3;

std::vector<int> United(const std::vector<int>& a, const std::vector<int>& b) {
  std::set<int> all(a.begin(), a.end());
  all.insert(b.begin(), b.end());
  return {all.begin(), all.end()};
}

std::vector<Item> WithoutUnknowns(std::vector<Item> completions, const std::vector<int>& known) {
  for (Item& item : completions) {
    std::vector<int>& own = item.unknowns;
    own.erase(std::remove_if(
                  own.begin(),
                  own.end(),
                  [&](int k) { return std::find(known.begin(), known.end(), k) != known.end(); }),
              own.end());
    item.size = static_cast<int>(own.size());
    item.positive.resize(own.size());
    item.typical.conservativeResize(item.size);
    item.precision.conservativeResize(item.size);
  }
  completions.erase(
      std::remove_if(
          completions.begin(), completions.end(), [](const Item& item) { return item.size == 0; }),
      completions.end());
  return completions;
}

}  // namespace

std::vector<int> WithUnknowns(std::vector<int> geometry, const std::vector<Item>& completions) {
  for (const Item& item : completions) {
    geometry.insert(geometry.end(), item.unknowns.begin(), item.unknowns.end());
  }
  std::sort(geometry.begin(), geometry.end());
  return geometry;
}

Loop::Loop(const LoopInputs& inputs)
    : in_(inputs),
      model_(*inputs.model),
      poses_(PosesOfRows(inputs.model->calibration().recording)),
      noise_(inputs.noise) {}

EvidenceRule Loop::RuleAt(const JointRows& joint, std::size_t geometry, int names) const {
  EvidenceRule rule;
  const double rows = std::max(2, joint.rows->degrees_of_freedom());
  rule.sigma_known = in_.sigma_known;
  rule.dof = std::max(
      1.0,
      (rows - std::min<double>(static_cast<double>(geometry), rows / 2)) / in_.readings_per_pose);
  rule.poses = std::max(2.0, NumPoses());
  rule.names = names;
  return rule;
}

std::vector<Item> Loop::Items(const JointRows& joint, bool coarse) const {
  LibraryOptions options;
  options.names = in_.names;
  for (const Member& member : joint.state.members) {
    (member.given ? options.switched : options.near).push_back(member.item.request);
    if (member.item.kind == ItemKind::kCell && IsByTheClock(member.item, *joint.context)) {
      options.clocked.push_back(member.item.slot);
    }
  }
  options.num_poses = static_cast<int>(NumPoses());
  options.masses_given = model_.masses_given();
  options.coarse = coarse;
  std::vector<Item> items = NamedItems(*joint.context, options);
  std::vector<Item> cells = CellItems(*joint.context);
  items.insert(
      items.end(), std::make_move_iterator(cells.begin()), std::make_move_iterator(cells.end()));
  return items;
}

void Loop::AddLines(const JointRows& joint,
                    const EvidenceRule& rule,
                    bool with_rivals,
                    Bank* bank) const {
  if (!in_.names.empty() &&
      std::find(in_.names.begin(), in_.names.end(), kLineEffect) == in_.names.end()) {
    return;
  }
  std::vector<std::vector<int>> contexts = {bank->members()};
  if (!bank->members().empty()) contexts.emplace_back();
  // Without the lines that there are: their orders are found anew beside what came in since.
  std::vector<int> no_lines;
  for (const int k : bank->members()) {
    const Item& item = bank->items()[static_cast<std::size_t>(k)];
    // Among rivals whole orders have theirs, too.
    const bool line =
        with_rivals ? item.request.effect == kLineEffect : IsScannedLine(item.request);
    if (!line) no_lines.push_back(k);
  }
  if (!no_lines.empty() && no_lines.size() < bank->members().size()) contexts.push_back(no_lines);
  for (const std::vector<int>& active : contexts) {
    const Bank::Rest rest = bank->RestBeside(active);
    const ScannedRows scanned{rest.basis, rest.y, rule.dof, rule.sigma_known, with_rivals};
    for (const SpectralPeak& peak : ScanOrders(*joint.context, *joint.rows, scanned)) {
      EffectRequest line;
      line.effect = kLineEffect;
      line.joint = peak.joint + 1;
      line.settings["order"] = std::round(peak.order * 100) / 100;
      Item item = NamedItem(*joint.context, line, 1);
      // At few places whole orders are no likelier than those that they cannot be told from.
      if (with_rivals && StopsAtFewPlaces(joint.context->q(peak.joint))) item.variants = 1;
      const bool known = std::any_of(bank->items().begin(),
                                     bank->items().end(),
                                     [&](const Item& other) { return other.SameAs(item); });
      if (!known) bank->Add(std::move(item));
    }
  }
}

JointRows Loop::WithInstantsMoved(JointRows joint) const {
  const Calibration& c = model_.calibration();
  RowChoice all = Choice();
  all.readings = c.readings.fitted;
  const auto missed = [&](const JointState& state) {
    const VectorXd y = model_.ResidualsAt(state, all);
    const int m = joint.rows->coordinates();
    double sum = 0;
    for (Index k = 0; k < y.size(); k += m) sum += BoundedSquare(y.segment(k, m).squaredNorm());
    return sum;
  };
  bool moved = false;
  JointState state = joint.state;
  for (Member& member : state.members) {
    const auto setting = member.item.request.settings.find(StepSetting(*joint.context));
    if (member.given || setting == member.item.request.settings.end()) continue;
    double least = missed(state), best = setting->second;
    for (const double instant : InstantsAround(*joint.context, setting->second, kInstantsAround)) {
      setting->second = instant;
      const double now = missed(state);
      if (now >= least) continue;
      least = now;
      best = instant;
      moved = true;
    }
    setting->second = best;
  }
  return moved ? FitJointly(model_, state, Choice(), joint.free, 2) : std::move(joint);
}

std::vector<int> Loop::UnknownZeros(const JointRows& joint) const {
  std::set<int> slots;
  for (const Member& member : joint.state.members) {
    if (member.item.kind != ItemKind::kEffect) continue;
    if (!FindEffect(member.item.request.effect)->Describe().zero_unknown) continue;
    for (const auto& column : ColumnsOf(member.item, *joint.context)) {
      for (const SlotWeights& w : column) slots.insert(w.slot);
    }
  }
  std::vector<int> unknowns;
  const auto& parameters = model_.calibration().parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (slots.count(parameters[k].slot) > 0) unknowns.push_back(static_cast<int>(k));
  }
  return unknowns;
}

Loop::Found Loop::SearchAt(const JointRows& joint,
                           const std::vector<int>& geometry,
                           const std::vector<Item>& completions,
                           bool list) const {
  std::vector<Item> items = Items(joint, false);
  items.insert(items.end(), completions.begin(), completions.end());
  std::set<std::string> names;
  for (const Item& item : items) {
    if (item.is_name()) names.insert(item.kind == ItemKind::kEffect ? item.counted_as : item.id);
  }
  Found found;
  found.names = static_cast<int>(names.size());
  const EvidenceRule rule = RuleAt(joint, geometry.size(), found.names);
  Bank bank(model_, joint, std::move(items), geometry);
  AddLines(joint, rule, list, &bank);
  AddTimeConstants(*joint.context, &bank);
  const std::vector<int> chosen = Shortlist(bank, rule);
  std::vector<GramItem> gram_items;
  int first = 0;
  for (const int i : chosen) {
    const Item& item = bank.items()[static_cast<std::size_t>(i)];
    GramItem own;
    own.id = item.id;
    own.first = first;
    own.size = item.size;
    own.variants = item.variants;
    own.unnamed = item.kind == ItemKind::kCell;
    own.chosen_name = item.kind != ItemKind::kCompletion;
    own.positive = item.positive;
    if (item.kind == ItemKind::kEffect) {
      own.typical = item.typical;
      own.taken_for = item.taken_for;
    }
    first += item.size;
    gram_items.push_back(std::move(own));
  }
  SetEvaluator evaluator(bank.GramOf(chosen), std::move(gram_items), rule);
  ItemSet now, all_completions;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Item& item = bank.items()[static_cast<std::size_t>(chosen[k])];
    const bool member =
        std::find(bank.members().begin(), bank.members().end(), chosen[k]) != bank.members().end();
    if (member) now.push_back(static_cast<int>(k));
    if (item.kind == ItemKind::kCompletion) all_completions.push_back(static_cast<int>(k));
  }
  std::vector<ItemSet> starts = {now};
  if (!all_completions.empty()) {
    ItemSet with_all = now;
    for (const int k : all_completions) with_all = With(with_all, k);
    starts.push_back(with_all);
    starts.push_back(all_completions);
    // What the model has freed of the geometry belongs to it.
    ItemSet with_freed = now;
    for (const int k : all_completions) {
      const Item& item =
          bank.items()[static_cast<std::size_t>(chosen[static_cast<std::size_t>(k)])];
      const bool freed = std::all_of(item.unknowns.begin(), item.unknowns.end(), [&](int u) {
        return std::find(joint.free.begin(), joint.free.end(), u) != joint.free.end();
      });
      if (freed) with_freed = With(with_freed, k);
    }
    starts.push_back(with_freed);
    if (list) now = with_freed;
  }
  const BeamOutcome outcome = SearchSets(starts, &evaluator);
  const auto items_of = [&](const ItemSet& set) {
    std::vector<Item> of_set;
    for (const int k : set) {
      const int i = chosen[static_cast<std::size_t>(k)];
      of_set.push_back(bank.items()[static_cast<std::size_t>(i)]);
    }
    return of_set;
  };
  found.items = items_of(outcome.best);
  found.values = evaluator.Evaluate(outcome.best).values;
  if (list) {
    for (const ItemSet& set : NotToldApart(outcome, now, kTuning.list_margin, &evaluator)) {
      found.listed.push_back(items_of(set));
    }
  }
  return found;
}

JointRows Loop::Eliminate(JointState start,
                          const std::vector<int>& geometry,
                          const RowChoice& choice,
                          int iterations,
                          std::vector<Item>* completions) const {
  while (true) {
    const std::vector<int> free = WithUnknowns(geometry, *completions);
    JointRows joint = FitJointly(model_, start, choice, free, iterations);
    const EvidenceRule rule = RuleAt(joint, free.size(), names_);
    const Weakest weakest = WeakestOf(model_, joint, *completions, rule, in_.false_alarm);
    Trace("to eliminate", joint);
    if (weakest.member < 0 && weakest.completion < 0) return joint;
    start = joint.state;
    if (weakest.member >= 0) {
      start.members.erase(start.members.begin() + weakest.member);
      if (!weakest.by_size) continue;
      const JointRows without = FitJointly(model_, start, choice, free, kFarSteps);
      if (without.y().norm() < kTuning.unmistakable * joint.y().norm()) continue;
      start = joint.state;
      start.members[static_cast<std::size_t>(weakest.member)].whatever_size = true;
      continue;
    }
    for (const int k : (*completions)[static_cast<std::size_t>(weakest.completion)].unknowns) {
      start.geometry[k] = 0;
    }
    completions->erase(completions->begin() + weakest.completion);
  }
}

void Loop::Trace(const std::string& step, const JointRows& joint) const {
  if (!VLOG_IS_ON(1)) return;
  std::string members;
  for (const Member& member : joint.state.members) members += " " + member.item.id;
  VLOG(1) << fmt::format(
      "{}: misfit {:.4g}, sigma {:.4g} m, correlation {:.2f}, joints {:.3g} rad, {} set aside;{}",
      step,
      joint.y().squaredNorm() / std::max(1, joint.rows->degrees_of_freedom()),
      noise_.sigma,
      slow_.correlation(),
      joint_noise_,
      off_.size(),
      members.empty() ? " no member" : members);
}

LoopOutcome Loop::Run() {
  const std::vector<int> all = model_.AllUnknowns();
  const auto say = [&](const std::string& text, double share) {
    if (in_.progress) in_.progress({"left-out physics: " + text, share});
  };
  say("first model", kShareAtStart);
  RobustStart();
  JointRows joint = FitJointly(model_, model_.Start(), Choice(), all, kFarSteps);
  Trace("first model", joint);
  const auto taken_up = [&](const Found& found, const JointState& from) {
    JointState state = from;
    std::vector<Member> given;
    for (const Member& member : from.members) {
      if (member.given) given.push_back(member);
    }
    state.members = given;
    for (std::size_t k = 0; k < found.items.size(); ++k) {
      if (found.items[k].kind == ItemKind::kCompletion) continue;
      state.members.push_back({found.items[k], found.values[k], false});
    }
    return state;
  };
  const auto same_members = [](const JointState& a, const JointState& b) {
    if (a.members.size() != b.members.size()) return false;
    return std::all_of(a.members.begin(), a.members.end(), [&](const Member& m) {
      return std::any_of(b.members.begin(), b.members.end(), [&](const Member& other) {
        return m.item.SameAs(other.item);
      });
    });
  };
  for (int round = 0; round < kTuning.rounds; ++round) {
    say(fmt::format("search, round {}", round + 1),
        kShareAtRounds + (kShareAfterRounds - kShareAtRounds) * round / kTuning.rounds);
    const Found found = SearchAt(joint, all, {}, false);
    names_ = found.names;
    const JointState before = joint.state;
    joint = FitJointly(model_, taken_up(found, before), Choice(), all, kNearSteps);
    bool changed = !same_members(before, joint.state);
    if (!off_.empty()) joint = WithInstantsMoved(std::move(joint));
    if (UpdateRows(&joint)) changed = true;
    Trace(fmt::format("round {}", round + 1), joint);
    if (!changed) break;
    joint = FitJointly(model_, joint.state, Choice(), all, 1);
  }
  std::vector<Item> completions;
  joint = Eliminate(joint.state, all, Choice(), kNearSteps, &completions);
  Trace("with the complete geometry", joint);
  std::vector<int> geometry = all;
  if (!in_.completions.empty()) {
    say("with the geometry of the problem file", kShareAfterRounds);
    const std::vector<int> zeros = UnknownZeros(joint);
    geometry = United(in_.file_unknowns, zeros);
    in_.completions = WithoutUnknowns(in_.completions, zeros);
    const Found found = SearchAt(joint, geometry, in_.completions, false);
    JointState state = taken_up(found, joint.state);
    std::set<int> kept(geometry.begin(), geometry.end());
    for (const Item& item : found.items) {
      if (item.kind != ItemKind::kCompletion) continue;
      completions.push_back(item);
      kept.insert(item.unknowns.begin(), item.unknowns.end());
    }
    for (Index k = 0; k < state.geometry.size(); ++k) {
      if (kept.count(static_cast<int>(k)) == 0) state.geometry[k] = 0;
    }
    joint = Eliminate(state, geometry, Choice(), kNearSteps, &completions);
  }
  Trace("at the end", joint);
  say("alternatives", kShareAtAlternatives);
  const Found alternatives = SearchAt(joint, geometry, in_.completions, true);
  LoopOutcome outcome;
  outcome.listed = alternatives.listed;
  outcome.geometry = geometry;
  outcome.free = WithUnknowns(geometry, completions);
  outcome.completions = std::move(completions);
  outcome.rule = RuleAt(joint, outcome.free.size(), names_);
  outcome.fit = std::move(joint);
  outcome.noise = noise_;
  outcome.overstated = overstated_;
  outcome.slow = slow_;
  outcome.joint_noise = joint_noise_;
  outcome.off = off_;
  outcome.moved = moved_;
  return outcome;
}

}  // namespace dhcal
