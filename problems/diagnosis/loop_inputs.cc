#include "problems/diagnosis/loop_inputs.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/completions.h"
#include "problems/diagnosis/concealed_frame.h"
#include "problems/diagnosis/rows/read_out.h"
#include "problems/noise.h"

namespace dhcal {
namespace {

using Eigen::VectorXd;

/// Readings that are one draw together: several targets of one pose, or repeats that were too few
/// to be put together. Coordinates of one point (distances to anchors) are not.
double ReadingsPerPose(const Calibration& c) {
  if (c.measurement->kind().anchors || c.measurement->kind().pairs) return 1;
  const std::vector<int> poses = PosesOfRows(c.recording);
  std::set<int> distinct;
  for (const Reading& reading : c.readings.fitted) {
    distinct.insert(poses[static_cast<std::size_t>(reading.row_idx)]);
  }
  const double per_pose = static_cast<double>(c.readings.fitted.size()) /
                          std::max(1.0, static_cast<double>(distinct.size()));
  constexpr double kSeveral = 1.5;
  return per_pose < kSeveral ? 1 : per_pose;
}

/// Items of the geometry that the file leaves out.
std::vector<Item> CompletionItems(const std::vector<Completion>& completions,
                                  const Calibration& whole) {
  std::vector<Item> items;
  for (const Completion& completion : completions) {
    Item item;
    item.kind = ItemKind::kCompletion;
    item.request = completion.request;
    item.id = completion.request.effect + (completion.request.joint > 0
                                               ? fmt::format(".{}", completion.request.joint)
                                               : std::string());
    for (const Parameter& p : completion.parameters) {
      for (std::size_t k = 0; k < whole.parameters.size(); ++k) {
        if (whole.parameters[k].name == p.name) item.unknowns.push_back(static_cast<int>(k));
      }
    }
    item.size = static_cast<int>(item.unknowns.size());
    item.positive.assign(item.unknowns.size(), false);
    item.typical = VectorXd::Ones(item.size);
    item.precision = VectorXd::Zero(item.size);
    items.push_back(std::move(item));
  }
  return items;
}

/// Unknowns of the whole geometry that the file estimates.
std::vector<int> FileUnknowns(const Calibration& file, const Calibration& whole) {
  std::set<std::string> names;
  for (const Parameter& p : file.parameters) names.insert(p.name);
  std::vector<int> unknowns;
  for (std::size_t k = 0; k < whole.parameters.size(); ++k) {
    if (names.count(whole.parameters[k].name) > 0) unknowns.push_back(static_cast<int>(k));
  }
  return unknowns;
}

}  // namespace

DiagnosisResult ConcealedFramesIn(const ProblemSpec& spec,
                                  const JointModel& model,
                                  const Result& identified,
                                  const Progress& progress) {
  const Calibration& whole = model.calibration();
  const Recording& recording = whole.recording;
  const std::vector<Completion> missing = MissingCompletions(Calibration(spec, recording), whole);
  if (missing.empty()) return {};
  const auto complete = FitComplete(spec, recording, {}, progress);
  if (!complete->usable()) return {};
  return ConcealedFrames(spec, recording, identified, *complete, missing);
}

ProblemSpec WithEffectsHeld(ProblemSpec spec, const JointRows& fit) {
  spec.robot.links = fit.robot->links;
  for (const Member& member : fit.state.members) {
    // Those of the problem file are in it already.
    if (member.given || member.item.kind != ItemKind::kEffect) continue;
    spec.parameters.effects.push_back(WithValues(member.item, *fit.context, member.value));
    spec.parameters.effects.back().held = true;
  }
  return spec;
}

LoopInputs InputsOf(const ProblemSpec& spec,
                    const JointModel& model,
                    bool averaged,
                    const std::vector<Finding>& frames) {
  const Calibration& c = model.calibration();
  const Calibration file(spec, c.recording);
  LoopInputs inputs;
  inputs.model = &model;
  inputs.names = spec.diagnosis.effects;
  inputs.false_alarm = kShareOfNames * spec.diagnosis.false_alarm;
  inputs.readings_per_pose = ReadingsPerPose(c);
  inputs.sigma_known = SourceOfNoise(c).all_given() && !averaged && inputs.readings_per_pose == 1;
  inputs.read_out = ReadOutOf(c.recording, spec.robot);
  inputs.noise = InitialNoise(c);
  inputs.file_unknowns = FileUnknowns(file, c);
  std::vector<Completion> missing = MissingCompletions(file, c);
  const auto named =
      std::stable_partition(missing.begin(), missing.end(), [&](const Completion& completion) {
        return std::none_of(frames.begin(), frames.end(), [&](const Finding& finding) {
          return completion.request.SameAs(finding.effect);
        });
      });
  inputs.file_unknowns =
      WithUnknowns(inputs.file_unknowns, CompletionItems({named, missing.end()}, c));
  inputs.completions = CompletionItems({missing.begin(), named}, c);
  return inputs;
}

}  // namespace dhcal
