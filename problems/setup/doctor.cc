#include "problems/setup/doctor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/base/units.h"
#include "problems/setup/length_units.h"
#include "problems/setup/orientations.h"
#include "problems/setup/search.h"
#include "problems/setup/shifted_part.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

constexpr double kFarBetter = 4;      // times: what a cure must gain
constexpr double kFramesMoved = 2.5;  // ... and frames that are allowed to move between runs
constexpr double kPerCause = 1.6;     // times the misfit: what half a cause more must gain
constexpr double kNotTold = 1.5;      // times the best: what cannot be told from it
constexpr std::size_t kMostVerified = 6;
constexpr std::size_t kMostListed = 4;
constexpr std::size_t kEnough = 20;  // readings of a part that can be judged by itself

/// Readings of the run and target that most are of, without those that are exactly zero.
std::vector<Reading> LargestPart(const Calibration& c) {
  std::map<std::pair<int, int>, std::vector<Reading>> parts;
  const bool points = c.measurement->kind().is_point();
  for (const Reading& reading : c.readings.fitted) {
    if (points && c.measurement->Point(reading).isZero(0)) continue;
    const int run = c.recording.run(reading.row_idx);
    parts[{run, c.Target(reading.row_idx)}].push_back(reading);
  }
  std::vector<Reading> largest;
  for (const auto& [key, part] : parts) {
    if (part.size() > largest.size()) largest = part;
  }
  return largest.size() >= kEnough ? largest : c.readings.fitted;
}

/// A set-up whose misfit was found with all rows.
struct Verified {
  SetUp set_up;
  double rms = 0;
  int weight = 0;
  double reach = 1;  // [m] of the cured robot
  /// [m] in the lengths of the file's readings: a unit that makes everything small gains nothing.
  double AsRead() const { return rms / set_up.reading_scale; }
  double Rank() const { return AsRead() * std::pow(kPerCause, weight); }
};

Verified Verify(const Files& files, const SetUp& set_up) {
  const CuredFiles cured = Cured(files, set_up);
  return {set_up,
          FitFrames(cured.spec, cured.recording).rms,
          WeightOf(set_up),
          ReachOf(cured.spec.robot)};
}

/// The causes of one alternative, with the evidence behind each.
void Describe(const Files& files,
              const Verified& verified,
              double rms_before,
              int alternative,
              std::vector<SetupCause>* causes) {
  std::vector<SetupCause> own;
  for (const CauseKind* kind : CauseKinds()) kind->Describe(files, verified.set_up, &own);
  for (SetupCause& cause : own) {
    cause.alternative = alternative;
    cause.rms_before = rms_before;
    cause.rms_after = verified.rms;
    const std::string before =
        std::isfinite(rms_before) ? " instead of " + InMillimetres(rms_before) : "";
    cause.sentence = fmt::format("{}: {} the nominal robot fits to {}{}.",
                                 Capitalised(cause.sentence),
                                 own.size() == 1 ? "with that" : "with all of these",
                                 InMillimetres(verified.rms),
                                 before);
    causes->push_back(std::move(cause));
  }
}

/// What can be claimed of verified set-ups that gain so many times.
Findings Conclude(const Files& files,
                  std::vector<Verified> verified,
                  double rms_before,
                  double gain,
                  int most_weight) {
  Findings findings;
  std::sort(verified.begin(), verified.end(), [](const Verified& a, const Verified& b) {
    return a.Rank() < b.Rank();
  });
  if (verified.empty()) return findings;
  const Verified& best = verified.front();
  if (best.weight == 0 || best.weight > most_weight || !(best.rms <= kNominalFits * best.reach) ||
      !(gain * best.AsRead() <= rms_before)) {
    return findings;
  }
  std::vector<Verified> alternatives;
  for (const Verified& other : verified) {
    if (other.Rank() <= kNotTold * best.Rank() && other.weight > 0) alternatives.push_back(other);
  }
  if (alternatives.size() > kMostListed) alternatives.resize(kMostListed);
  for (std::size_t k = 0; k < alternatives.size(); ++k) {
    Describe(files, alternatives[k], rms_before, static_cast<int>(k) + 1, &findings.causes);
  }
  if (alternatives.size() == 1) findings.cured = Cured(files, best.set_up);
  return findings;
}

std::vector<Verified> VerifyAll(const Files& files, const std::vector<Candidate>& candidates) {
  std::vector<Verified> verified;
  for (const Candidate& candidate : candidates) {
    if (verified.size() >= kMostVerified) break;
    verified.push_back(Verify(files, candidate.set_up));
  }
  return verified;
}

/// Frames of the runs, tried on top of each.
void TryMovedFrames(const Files& files, std::vector<Verified>* verified) {
  if (files.recording.run_names.size() < 2) return;
  const std::vector<Verified> before = *verified;
  for (const Verified& one : before) {
    std::vector<SetUp> moved;
    FramePerRun().Neighbours(files, one.set_up, &moved);
    for (const SetUp& set_up : moved) {
      verified->push_back(Verify(files, set_up));
    }
  }
}

bool Solved(const std::vector<Verified>& verified) {
  return std::any_of(verified.begin(), verified.end(), [](const Verified& one) {
    return one.rms <= kNominalFits * one.reach;
  });
}

/// "x, y, z, w": what stands in the columns qw qx qy qz.
std::string Held(const QuaternionForm& form, const char* prefix) {
  constexpr std::array<const char*, 4> kNames = {"w", "x", "y", "z"};
  std::array<std::string, 4> held;
  for (std::size_t k = 0; k < 4; ++k) {
    held[static_cast<std::size_t>(form.order[k])] = std::string(prefix) + kNames[k];
  }
  return fmt::format("{}, {}, {}, {}", held[0], held[1], held[2], held[3]);
}

SetupCause DescribeForm(const Files& files, const OrientationForms& forms) {
  const QuaternionForm& form = forms.best;
  const bool ordered = form.order != QuaternionForm().order;
  SetupCause cause;
  cause.kind = "quaternion";
  cause.where = HeaderWhere(files);
  if (ordered) {
    cause.sentence = fmt::format("The columns qw, qx, qy, qz hold {}", Held(form, ""));
    cause.text = "name the four columns, in this order, " + Held(form, "q");
  }
  if (form.inverse) {
    cause.sentence += fmt::format("{} orientations are those of the instrument seen from the tool",
                                  ordered ? ", and the" : "The");
    cause.text += std::string(ordered ? ", and change" : "change") + " the signs of qx, qy and qz";
  }
  if (form.turned) {
    cause.sentence += fmt::format("{} orientations are in another frame than the positions",
                                  form.inverse ? ", and the" : "The");
    cause.text += std::string(form.inverse ? ", and give" : "give") +
                  " orientations in the frame of the positions, or use kind: position";
  }
  cause.sentence +=
      fmt::format(": with that they fit the robot to {:.2g} mrad instead of {:.0f} mrad.",
                  form.misfit / kMilliradian,
                  forms.as_written.misfit / kMilliradian);
  return cause;
}

}  // namespace

Findings FindCauses(const Files& files, double rms_before, int most_weight) {
  const ProblemSpec frames_only = FramesOnly(files.spec, files.recording);
  const Calibration calibration(frames_only, files.recording);
  const std::vector<Reading> part = LargestPart(calibration);
  const SetUpSearch search(files, calibration, part);
  if (!search.possible()) return {};
  std::vector<Verified> verified = VerifyAll(files, search.Run());
  if (!Solved(verified)) {
    const std::vector<Verified> remastered = VerifyAll(files, search.Remastered());
    verified.insert(verified.end(), remastered.begin(), remastered.end());
  }
  if (!Solved(verified)) TryMovedFrames(files, &verified);
  if (!Solved(verified) && part.size() >= 2 * kEnough) {
    // Something may happen in the middle: the beginning, and the end, by themselves.
    const auto third = static_cast<std::ptrdiff_t>(std::max(kEnough, part.size() / 3));
    for (const auto& piece : {std::vector<Reading>(part.begin(), part.begin() + third),
                              std::vector<Reading>(part.end() - third, part.end())}) {
      const SetUpSearch of_piece(files, calibration, piece);
      if (!of_piece.possible()) continue;
      for (const Candidate& candidate : of_piece.Run()) {
        const double reach = ReachOf(Cured(files, candidate.set_up).spec.robot);
        if (candidate.misfit.rms > kNominalFits * reach) continue;
        const std::optional<SetUp> shifted = ShiftedPart(files, candidate, piece);
        if (!shifted) continue;
        verified.push_back(Verify(files, *shifted));
      }
      if (Solved(verified)) break;
    }
  }
  return Conclude(files, std::move(verified), rms_before, kFarBetter, most_weight);
}

Findings FindMovedFrames(const Files& files, double rms_before) {
  std::vector<Verified> verified = {
      {AsWritten(files.num_joints()), rms_before, 0, ReachOf(files.robot())}};
  TryMovedFrames(files, &verified);
  return Conclude(files, std::move(verified), rms_before, kFramesMoved, 2 * kOneCause);
}

OrientationFindings FindOrientationForm(const Files& files, const FramesAlone& frames_alone) {
  constexpr double kClearly = 0.2;  // of the misfit as written
  OrientationFindings result;
  const Recording& recording = files.recording;
  if (!frames_alone.frames) return result;
  const ProblemSpec frames_only = FramesOnly(files.spec, recording);
  Calibration c(frames_only, recording);
  c.frames = *frames_alone.frames;
  const std::optional<OrientationForms> forms = JudgeOrientations(c);
  if (!forms) return result;
  result.misfit = forms->as_written.misfit;
  if (!(result.misfit > kFollowsRobot)) return result;
  const double best = forms->best.misfit;
  if (!(best < kFollowsRobot && best < kClearly * result.misfit)) return result;
  result.findings.causes.push_back(DescribeForm(files, *forms));
  if (!forms->best.turned) {
    result.findings.cured = CuredFiles{files.spec, recording};
    result.findings.cured->recording.quaternion = InForm(recording.quaternion, forms->best);
  }
  return result;
}

}  // namespace dhcal
