#include "problems/setup/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "problems/setup/length_units.h"

namespace dhcal {
namespace {

constexpr std::size_t kWidth = 40;  // set-ups from which steps are made
constexpr int kMostRounds = 6;
constexpr double kProgress = 0.98;         // of the misfit, in a round that is worth another
constexpr std::size_t kMostOrders = 1000;  // far jumps of a kind that are tried under all others
constexpr double kAsGood = 1.15;           // times the misfit: what a cause less may cost
constexpr double kNearlyAsGood = 2;        // times the best misfit: what is kept
constexpr std::size_t kMostKept = 12;
constexpr int kFewestReadings = 8;
constexpr int kZeroSteps = 24;  // of a turn, in the scan for a zero
constexpr double kZeroStep = 2 * kPi / kZeroSteps;
constexpr int kZeroHalvings = 10;  // of a step: to 0.015 deg

/// Evenly over `readings`, those whose row may be shifted within its run.
std::vector<Reading> Few(const Recording& recording, const std::vector<Reading>& readings) {
  std::vector<Reading> usable;
  for (const Reading& reading : readings) {
    const int first = reading.previous_idx >= 0 ? reading.previous_idx : reading.row_idx;
    const int from = first - kMostRowShift, to = reading.row_idx + kMostRowShift;
    if (from < 0 || to >= recording.num_rows()) continue;
    if (recording.run(from) != recording.run(to)) continue;
    usable.push_back(reading);
  }
  if (static_cast<int>(usable.size()) < kFewestReadings) return {};
  std::vector<Reading> few;
  const std::size_t count = std::min<std::size_t>(usable.size(), kMostSetUpRows);
  for (std::size_t k = 0; k < count; ++k) few.push_back(usable[k * usable.size() / count]);
  return few;
}

bool Better(const Candidate& a, const Candidate& b) {
  if (a.misfit.rms != b.misfit.rms) return a.misfit.rms < b.misfit.rms;
  return a.weight < b.weight;
}

}  // namespace

SetUpSearch::SetUpSearch(const Files& files,
                         const Calibration& calibration,
                         const std::vector<Reading>& readings)
    : files_(files), readings_(Few(files.recording, readings)), fit_(calibration, readings_) {
  for (int shift = -kMostRowShift; shift <= kMostRowShift; ++shift) {
    std::vector<int> rows, rows_before;
    for (const Reading& reading : readings_) {
      rows.push_back(reading.row_idx + shift);
      rows_before.push_back(reading.previous_idx + shift);
    }
    now_.emplace_back(files.robot(), files.recording, rows);
    // Differences that were read as such: each has a row before.
    if (calibration.measurement->kind().pairs) {
      before_.emplace_back(files.robot(), files.recording, rows_before);
    }
  }
}

Candidate SetUpSearch::Judge(SetUp set_up) const {
  const int of_shift = set_up.shift + kMostRowShift;
  const auto shift = static_cast<std::size_t>(of_shift);
  FlangePoses now, before;
  now_[shift].Evaluate(set_up, &now);
  if (!before_.empty()) before_[shift].Evaluate(set_up, &before);
  Candidate candidate;
  candidate.misfit = fit_.Fit(now, before);
  // A step may have said already what the table's unit is.
  std::optional<LengthFactors> factors = LengthFactors{set_up.table_scale, candidate.misfit.scale};
  if (set_up.table_scale == 1) factors = UnitsOf(files_.robot(), candidate.misfit.scale);
  if (factors) {
    candidate.misfit.p_TQ *= factors->table / set_up.table_scale;
    set_up.table_scale = factors->table;
    set_up.reading_scale = factors->readings;
  } else {
    candidate.misfit.rms = std::numeric_limits<double>::infinity();
  }
  set_up.tool_scale = ToolScale(files_.robot(), candidate.misfit.p_TQ);
  set_up.mirrored = candidate.misfit.mirrored;
  candidate.weight = WeightOf(set_up);
  candidate.set_up = std::move(set_up);
  return candidate;
}

std::vector<Candidate> SetUpSearch::JudgeAll(const std::vector<SetUp>& set_ups) const {
  constexpr int kPieces = 64;
  std::vector<Candidate> judged(set_ups.size());
  ParallelFor(kPieces, [&](int piece) {
    for (auto k = static_cast<std::size_t>(piece); k < set_ups.size(); k += kPieces) {
      judged[k] = Judge(set_ups[k]);
    }
  });
  return judged;
}

std::vector<SetUp> SetUpSearch::Steps(const SetUp& from) const {
  std::vector<SetUp> steps;
  for (const CauseKind* kind : CauseKinds()) kind->Neighbours(files_, from, &steps);
  return steps;
}

std::vector<SetUp> SetUpSearch::Seeds() const {
  const SetUp as_written = AsWritten(files_.num_joints());
  std::vector<SetUp> seeds = {as_written};
  // All pairs of steps.
  for (const SetUp& step : Steps(as_written)) {
    seeds.push_back(step);
    for (SetUp& second : Steps(step)) seeds.push_back(std::move(second));
  }
  // Under what spoils everything, alone or together, the far jumps of the other kinds.
  std::vector<SetUp> alone, modes = {as_written};
  for (const CauseKind* kind : CauseKinds()) {
    if (kind->spoils_all()) kind->Neighbours(files_, as_written, &alone);
  }
  for (const SetUp& mode : alone) {
    modes.push_back(mode);
    if (mode.other_convention) continue;
    modes.push_back(mode);
    modes.back().other_convention = true;
  }
  for (const SetUp& mode : modes) {
    for (const CauseKind* kind : CauseKinds()) {
      std::vector<SetUp> jumps;
      kind->FarJumps(files_, mode, &jumps);
      const bool plain = mode == as_written;
      if (!plain && jumps.size() > kMostOrders) continue;
      seeds.insert(seeds.end(), jumps.begin(), jumps.end());
    }
  }
  return seeds;
}

void SetUpSearch::Simplify(Candidate* candidate) const {
  const double allowed = kAsGood * candidate->misfit.rms;
  while (true) {
    std::vector<SetUp> simpler;
    for (const CauseKind* kind : CauseKinds()) kind->Undo(candidate->set_up, &simpler);
    std::vector<Candidate> judged = JudgeAll(simpler);
    judged.erase(std::remove_if(judged.begin(),
                                judged.end(),
                                [&](const Candidate& other) {
                                  return other.misfit.rms > allowed ||
                                         other.weight > candidate->weight ||
                                         (other.weight == candidate->weight &&
                                          !(other.misfit.rms < candidate->misfit.rms));
                                }),
                 judged.end());
    if (judged.empty()) return;
    *candidate =
        *std::min_element(judged.begin(), judged.end(), [](const Candidate& a, const Candidate& b) {
          return std::pair(a.weight, a.misfit.rms) < std::pair(b.weight, b.misfit.rms);
        });
  }
}

void SetUpSearch::RefineZero(int joint_idx, Candidate* candidate) const {
  const auto idx = static_cast<std::size_t>(joint_idx);
  const auto moved = [&](double angle) {
    SetUp set_up = candidate->set_up;
    set_up.joints[idx].offset += angle;
    Candidate other = Judge(set_up);
    if (!(other.misfit.rms < candidate->misfit.rms)) return false;
    *candidate = std::move(other);
    return true;
  };
  // Ever smaller steps downhill: the misfit is smooth around its least.
  double step = kZeroStep;
  for (int k = 0; k < kZeroHalvings; ++k) {
    step /= 2;
    if (!moved(step)) moved(-step);
  }
}

std::vector<Candidate> SetUpSearch::Remastered() const {
  const SetUp as_written = AsWritten(files_.num_joints());
  std::vector<SetUp> starts = Steps(as_written), turned;
  starts.push_back(as_written);
  for (const SetUp& start : starts) {
    for (int j = 0; j < files_.num_joints(); ++j) {
      if (!files_.revolute(j)) continue;
      for (int k = 1; k < kZeroSteps; ++k) {
        turned.push_back(start);
        turned.back().joints[static_cast<std::size_t>(j)].offset =
            std::remainder(k * kZeroStep, 2 * kPi);
      }
    }
  }
  std::vector<Candidate> candidates = JudgeAll(turned);
  std::sort(candidates.begin(), candidates.end(), Better);
  if (candidates.size() > kWidth) candidates.resize(kWidth);
  for (Candidate& candidate : candidates) {
    for (int j = 0; j < files_.num_joints(); ++j) {
      const double offset = candidate.set_up.joints[static_cast<std::size_t>(j)].offset;
      if (offset != 0) RefineZero(j, &candidate);
    }
  }
  std::sort(candidates.begin(), candidates.end(), Better);
  return Kept(candidates);
}

std::vector<Candidate> SetUpSearch::Run() const {
  std::set<SetUp> seen;
  const auto unseen = [&](const std::vector<SetUp>& set_ups) {
    std::vector<SetUp> fresh;
    for (const SetUp& set_up : set_ups) {
      if (seen.insert(set_up).second) fresh.push_back(set_up);
    }
    return fresh;
  };
  std::vector<Candidate> beam = JudgeAll(unseen(Seeds()));
  for (int round = 0; round < kMostRounds; ++round) {
    std::sort(beam.begin(), beam.end(), Better);
    const double best = beam.front().misfit.rms;
    std::vector<SetUp> next;
    for (std::size_t k = 0; k < std::min(kWidth, beam.size()); ++k) {
      // What the fit finds is no step.
      SetUp from = beam[k].set_up;
      from.reading_scale = 1;
      from.tool_scale = 1;
      from.table_scale = 1;
      from.mirrored = false;
      for (SetUp& step : Steps(from)) next.push_back(std::move(step));
    }
    std::vector<Candidate> judged = JudgeAll(unseen(next));
    beam.insert(beam.end(), judged.begin(), judged.end());
    std::sort(beam.begin(), beam.end(), Better);
    if (!(beam.front().misfit.rms < kProgress * best)) break;
  }
  return Kept(beam);
}

std::vector<Candidate> SetUpSearch::Kept(const std::vector<Candidate>& sorted) const {
  std::vector<Candidate> kept;
  for (Candidate candidate : sorted) {
    if (candidate.misfit.rms > kNearlyAsGood * sorted.front().misfit.rms) break;
    if (kept.size() >= kMostKept) break;
    Simplify(&candidate);
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return other.set_up == candidate.set_up;
    });
    if (is_new) kept.push_back(candidate);
  }
  std::sort(kept.begin(), kept.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.weight, a.misfit.rms) < std::pair(b.weight, b.misfit.rms);
  });
  return kept;
}

}  // namespace dhcal
