#include "tools/plan/run.h"

#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "core/base/flag_values.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/io/whole_file.h"
#include "core/report/text_renderer.h"
#include "problems/formats/problem/problem_checks.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tools/plan/split_run.h"
#include "tools/plan/words.h"

namespace dhcal {
namespace {

constexpr int kMostPoses = 100000;

/// "0.8,-0.5,0.2,1.5,0.5,1.2": two corners [m].
void ReadVolume(const std::string& text, FlagValues* flags, std::optional<TaskBox>* volume) {
  if (text.empty()) return;
  std::vector<double> numbers;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    if (const std::optional<double> number = ParseDouble(item)) numbers.push_back(*number);
  }
  if (numbers.size() == 6) {
    const Eigen::Vector3d a(numbers[0], numbers[1], numbers[2]);
    const Eigen::Vector3d b(numbers[3], numbers[4], numbers[5]);
    *volume = TaskBox{a.cwiseMin(b), a.cwiseMax(b)};
    if (((*volume)->high - (*volume)->low).minCoeff() > 0) return;
  }
  flags->Wrong("volume_m", text, "two opposite corners, x,y,z,x,y,z in m in the robot's base,");
}

PlanOptions OptionsOf(const PlanCommand& command, Diagnostics* diagnostics) {
  FlagValues flags(diagnostics);
  PlanOptions options;
  flags.Whole("poses", command.poses, 1, kMostPoses, &options.count);
  flags.Whole("candidates", command.candidates, 1, kMostPoses, &options.candidates);
  int seed = 1;
  flags.Whole("seed", command.seed, 0, kMostPoses, &seed);
  options.seed = static_cast<std::uint64_t>(seed);
  if (command.criterion == "I") options.criterion = DesignCriterion::kI;
  if (!command.criterion.empty() && command.criterion != "I" && command.criterion != "D") {
    flags.Wrong("criterion", command.criterion, "D or I");
  }
  ReadVolume(command.volume, &flags, &options.volume);
  EdgePlan& edge = options.edge;
  flags.Whole("edge_poses", command.edge_poses, 2, kMostPoses, &edge.poses);
  double number = 0;
  if (flags.Number("edge_length_mm", command.edge_length, 1, 1e5, &number)) {
    edge.length = number * kMillimetre;
  }
  if (flags.Number("stand_off_mm", command.stand_off, 0, 1e4, &number)) {
    edge.stand_off = number * kMillimetre;
  }
  if (flags.Number("tilt_deg", command.tilt, 0, 80, &number)) edge.tilt = number * kDegree;
  if (flags.Number("slope_deg", command.slope, 0, 180, &number)) edge.slope = number * kDegree;
  return options;
}

/// The recording that the problem file has: where it names a file that is not there yet, none.
std::optional<Recording> OwnRecording(const ProblemSpec& spec,
                                      std::ostream& messages,
                                      Diagnostics* diagnostics) {
  std::optional<Recording> own;
  if (spec.simulate) {
    own = SimulateRecording(spec, diagnostics);
  } else {
    Diagnostics missing;
    if (!CheckRecordingExists(spec, &missing)) {
      messages << "dhcal_plan: the recording is not there yet; the plan is made without it.\n";
      return std::nullopt;
    }
    own = ReadRecording(spec.recording, spec.robot.joints, spec.columns, diagnostics);
  }
  if (!own || !diagnostics->ok()) return std::nullopt;
  CheckRecordingFits(spec, *own, diagnostics);
  if (diagnostics->ok()) CheckEnoughReadings(spec, *own, diagnostics);
  return own;
}

/// A file of poses as a whole, and what is said of it.
struct Written {
  Recording rows;
  Document report;
};

std::optional<Written> MakePlan(const ProblemSpec& spec,
                                const std::optional<Recording>& own,
                                const PlanOptions& options,
                                const std::string& file,
                                Diagnostics* diagnostics) {
  std::optional<Plan> plan = PlanPoses(spec, own ? &*own : nullptr, options, diagnostics);
  if (!plan) return std::nullopt;
  const Document report = PlanReport(spec, *plan, file);
  return Written{std::move(plan->rows), report};
}

std::optional<Written> MakeSplit(const ProblemSpec& spec,
                                 const std::optional<Recording>& own,
                                 const PlanCommand& command,
                                 const PlanOptions& options,
                                 Diagnostics* diagnostics) {
  if (!own) {
    diagnostics->Error({spec.file}, "alternatives are those of a recording; there is none");
    return std::nullopt;
  }
  const std::optional<std::vector<Alternative>> alternatives =
      command.result.empty() ? DiagnosedAlternatives(spec, *own)
                             : ReadAlternatives(command.result, diagnostics);
  if (!alternatives) return std::nullopt;
  SplitOptions split;
  if (options.count > 0) split.count = options.count;
  if (options.candidates > 0) split.candidates = options.candidates;
  split.seed = options.seed;
  split.volume = options.volume;
  std::optional<SplitPlan> plan = PlanSplit(spec, *own, *alternatives, split, diagnostics);
  if (!plan) return std::nullopt;
  const Document report = SplitReport(spec, *plan, command.out);
  return Written{std::move(plan->rows), report};
}

}  // namespace

int RunPlan(const PlanCommand& command, std::ostream& out, std::ostream& messages) {
  Diagnostics diagnostics;
  if (command.problem.empty()) {
    diagnostics.Error({"command line"}, "--problem is missing; give a problem file");
  }
  const PlanOptions options = OptionsOf(command, &diagnostics);
  const auto refuse = [&] {
    messages << diagnostics.ToString();
    return kPlanBadInput;
  };
  if (!diagnostics.ok()) return refuse();
  const std::optional<ProblemSpec> spec =
      ReadProblemFile(command.problem, command.data_dir, &diagnostics);
  if (!spec) return refuse();
  const std::optional<Recording> own = OwnRecording(*spec, messages, &diagnostics);
  if (!diagnostics.ok()) return refuse();
  PlanCommand named = command;
  if (named.out.empty()) named.out = spec->name + "_plan.csv";
  const bool split = command.split || !command.result.empty();
  const std::optional<Written> plan = split
                                          ? MakeSplit(*spec, own, named, options, &diagnostics)
                                          : MakePlan(*spec, own, options, named.out, &diagnostics);
  if (!plan) return refuse();
  const std::string csv = RecordingToCsv(plan->rows, spec->robot);
  if (!WriteWholeFile(named.out, csv, &diagnostics)) return refuse();
  messages << diagnostics.ToString();
  out << ToText(plan->report);
  return kPlanOk;
}

}  // namespace dhcal
