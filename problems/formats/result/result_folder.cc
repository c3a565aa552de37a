// The result folder: which files it holds, when it may be replaced, and what goes into it.
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/folder_swap.h"
#include "core/io/posix_file.h"
#include "core/report/report.h"
#include "problems/formats/result/result_writer.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;

constexpr char kResultJson[] = "result.json";  // every result has it
constexpr char kRecordingCsv[] = "recording.csv";
constexpr char kCalibrated[] = "calibrated.yaml";
constexpr char kRigid[] = "calibrated_rigid.yaml";
constexpr char kPython[] = "calibrated.py";
constexpr char kUrdf[] = "calibrated.urdf";

const std::vector<std::string>& OwnNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {
        kResultJson, kCalibrated, kRigid, kPython, kUrdf, "residuals.csv", kRecordingCsv};
    for (const ReportFormat& format : ReportFormats()) all.emplace_back(format.file);
    return all;
  }();
  return names;
}

/// Absolute, without trailing slash, and behind a symbolic link the folder that it names.
fs::path Resolve(const std::string& directory) {
  fs::path folder = fs::absolute(directory).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  std::error_code ignored;
  return fs::is_symlink(folder, ignored) ? fs::weakly_canonical(folder) : folder;
}

/// Names in the folder that no result has; a subfolder or link is foreign under any name.
std::vector<std::string> ForeignNames(const fs::path& folder, bool* has_result) {
  std::vector<std::string> foreign;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool own = std::count(OwnNames().begin(), OwnNames().end(), name) > 0;
    if (!own || !fs::is_regular_file(entry.symlink_status())) foreign.push_back(name);
    if (name == kResultJson) *has_result = true;
  }
  std::sort(foreign.begin(), foreign.end());
  return foreign;
}

/// What forbids to replace a folder that exists; empty when nothing does.
std::string WhyNotReplaceable(const fs::path& folder) {
  if (!fs::is_directory(folder)) return "is not a folder; name another one with --out";
  if (fs::equivalent(folder, fs::current_path())) {
    return "is the current folder, which cannot be replaced while in use; name a folder in it";
  }
  bool has_result = false;
  std::vector<std::string> foreign = ForeignNames(folder, &has_result);
  if (!foreign.empty()) {
    const std::string more =
        foreign.size() > 3 ? fmt::format(" and {} more", foreign.size() - 3) : std::string();
    foreign.resize(std::min<std::size_t>(foreign.size(), 3));
    return fmt::format(
        "holds files that are not from an earlier result ({}{}) and is left alone; name an empty "
        "or new folder with --out",
        fmt::join(foreign, ", "),
        more);
  }
  if (!has_result && !fs::is_empty(folder)) {
    return fmt::format(
        "holds files but no {}, so it is no earlier result and is left alone; "
        "name an empty or new folder with --out",
        kResultJson);
  }
  return "";
}

/// Why nothing can be made in the nearest parent that exists; empty when it can.
std::string WhyParentNotWritable(const fs::path& folder) {
  fs::path parent = folder.parent_path();
  while (!fs::exists(parent) && parent.has_relative_path()) parent = parent.parent_path();
  if (!fs::is_directory(parent)) {
    return fmt::format("cannot be made: {} is not a folder", parent.string());
  }
  if (::access(parent.c_str(), W_OK | X_OK) == 0) return "";
  return fmt::format("cannot be made in {}: {}", parent.string(), ErrorText(errno));
}

/// A recording that lies in the folder to be replaced would be lost with it.
bool LiesIn(const std::string& file, const fs::path& folder) {
  std::error_code error;
  return !file.empty() && fs::equivalent(fs::absolute(file).parent_path(), folder, error) && !error;
}

/// A file as calibrated.yaml in the folder names it.
std::string SeenFrom(const fs::path& folder, const std::string& file) {
  const fs::path absolute = fs::absolute(file);
  std::error_code error;
  const fs::path relative = fs::proximate(absolute, folder, error);
  return (error ? absolute : relative).string();
}

std::string ReadBytes(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + " cannot be read any more");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The robot to run again: what the report announces, for Python, too, and where that has effects
/// which were found, the robot without them.
void AddCalibrated(const ProblemSpec& spec,
                   const Recording& recording,
                   const Result& result,
                   const std::string& recording_path,
                   std::vector<NamedContent>* files) {
  const std::vector<EffectRequest> of_file =
      EffectsAsFound(spec, recording, result.best()->parameters);
  const RobotModel& robot = result.delivered ? result.delivered->robot : result.calibrated;
  const std::vector<EffectRequest>& effects =
      result.delivered ? result.delivered->effects : of_file;
  files->push_back({kCalibrated, CalibratedYaml(spec, robot, effects, recording_path)});
  files->push_back({kPython, CalibratedPython(spec.name, robot, effects)});
  if (!result.delivered || !result.delivered->rigid) return;
  files->push_back(
      {kRigid, CalibratedYaml(spec, *result.delivered->rigid, of_file, recording_path)});
}

/// The folder's files. Throws std::runtime_error when an input has gone since it was read.
std::vector<NamedContent> Compose(const ProblemSpec& spec,
                                  const Recording& recording,
                                  const Result& result,
                                  const fs::path& folder,
                                  Diagnostics* diagnostics) {
  std::vector<NamedContent> files = {{kResultJson, ResultToJson(result)}};
  const Document report = ReportOf(spec, recording, result);
  for (const ReportFormat& format : ReportFormats()) {
    files.push_back({format.file, format.render(report)});
  }
  const bool keep_recording = LiesIn(spec.recording, folder);
  // A cured recording differs from the user's, and is what calibrated.yaml is of.
  const bool own_recording = result.simulated || result.setup.cured;
  if (own_recording) {
    files.push_back({kRecordingCsv, RecordingToCsv(recording, spec.robot)});
  } else if (keep_recording) {
    files.push_back({kRecordingCsv, ReadBytes(spec.recording)});
  }
  if (!result.residuals.empty()) {
    files.push_back({"residuals.csv", ResidualsToCsv(result, recording)});
  }
  // Without a usable fit there is no calibrated robot to run again.
  if (result.best() != nullptr) {
    const bool stored = own_recording || keep_recording;
    const std::string path = stored ? kRecordingCsv : SeenFrom(folder, spec.recording);
    ProblemSpec from_folder = spec;
    if (spec.task && !spec.task->file.empty()) {
      from_folder.task->file = SeenFrom(folder, spec.task->file);
    }
    AddCalibrated(from_folder, recording, result, path, &files);
    const std::string urdf = CalibratedUrdf(spec, result, diagnostics);
    if (!urdf.empty()) files.push_back({kUrdf, urdf});
  }
  return files;
}

}  // namespace

void CheckResultDirectory(const std::string& directory, Diagnostics* diagnostics) {
  std::string why;
  try {
    const fs::path folder = directory.empty() ? fs::path() : Resolve(directory);
    if (!folder.has_filename()) {
      why = "is no name for a result folder";
    } else {
      if (fs::exists(folder)) why = WhyNotReplaceable(folder);
      if (why.empty()) why = WhyParentNotWritable(folder);
    }
  } catch (const fs::filesystem_error& error) {
    why = "cannot be used as result folder: " + error.code().message();
  }
  if (!why.empty()) diagnostics->Error({directory}, why);
}

bool WriteResult(const ProblemSpec& spec,
                 const Recording& recording,
                 const Result& result,
                 const std::string& directory,
                 Diagnostics* diagnostics) {
  const int errors_before = diagnostics->num_errors();
  CheckResultDirectory(directory, diagnostics);
  if (diagnostics->num_errors() > errors_before) return false;
  try {
    const fs::path folder = Resolve(directory);
    const std::vector<NamedContent> files = Compose(spec, recording, result, folder, diagnostics);
    return ReplaceFolder(folder, files, OwnNames(), SwapMethod::kExchange, diagnostics);
  } catch (const std::runtime_error& error) {
    diagnostics->Error({spec.file}, fmt::format("the result cannot be written: {}", error.what()));
    return false;
  }
}

}  // namespace dhcal
