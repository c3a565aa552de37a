#include "tools/support/batch.h"

#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/text.h"
#include "core/report/error_table.h"
#include "core/report/first_screen.h"
#include "core/report/report.h"
#include "core/report/summary_table.h"
#include "core/report/text_renderer.h"
#include "core/report/text_table.h"
#include "problems/diagnosis/calibrate.h"
#include "problems/formats/problem/effects_reader.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/problem/solver_reader.h"
#include "problems/formats/result/result_writer.h"
#include "problems/judgement.h"
#include "problems/recording_of.h"
#include "tools/support/acceptance.h"
#include "tools/support/interrupt.h"
#include "tools/support/progress_printer.h"

namespace dhcal {
namespace {

/// A problem that is ready to be solved.
struct Job {
  ProblemSpec spec;
  Recording recording;
  std::string directory;
};

void ApplyOverrides(const CommandLine& command_line, ProblemSpec* spec, Diagnostics* diagnostics) {
  if (!command_line.method.empty() && !ParseSolverMethod(command_line.method, &spec->solver)) {
    diagnostics->Error({},
                       "--method " + command_line.method +
                           ": expected svd_gauss_newton, levenberg_marquardt or both");
  }
  if (!command_line.diagnosis.empty() &&
      !ParseDiagnosisRun(command_line.diagnosis, &spec->diagnosis)) {
    diagnostics->Error(
        {}, "--diagnosis " + command_line.diagnosis + ": expected auto, always or never");
  }
  const std::string& tolerance = command_line.singular_value_tolerance;
  if (!tolerance.empty() && !ParseTruncation(tolerance, &spec->solver)) {
    diagnostics->Error({},
                       "--singular_value_tolerance " + tolerance +
                           ": expected noise, paper or a number above 0 and below 1");
  }
}

std::string DirectoryOf(const CommandLine& command_line, const ProblemSpec& spec) {
  std::string own = spec.name + "_result";
  if (command_line.out.empty()) return own;
  if (command_line.problems.size() == 1) return command_line.out;
  return (std::filesystem::path(command_line.out) / own).string();
}

std::optional<Job> Prepare(const CommandLine& command_line,
                           const std::string& file,
                           Diagnostics* diagnostics) {
  std::optional<ProblemSpec> spec = ReadProblemFile(file, command_line.data_dir, diagnostics);
  if (!spec) return std::nullopt;
  ApplyOverrides(command_line, &*spec, diagnostics);
  std::optional<Recording> recording = RecordingOf(*spec, diagnostics);
  if (!recording) return std::nullopt;
  Job job{std::move(*spec), std::move(*recording), ""};
  job.directory = DirectoryOf(command_line, job.spec);
  CheckResultDirectory(job.directory, diagnostics);
  return job;
}

/// Two problems must not write into one folder.
void CheckDirectoriesDiffer(const std::vector<Job>& jobs, Diagnostics* diagnostics) {
  std::map<std::string, std::string> owner;
  for (const Job& job : jobs) {
    const auto [entry, is_new] = owner.try_emplace(job.directory, job.spec.file);
    if (is_new) continue;
    diagnostics->Error({job.spec.file, 0, 0},
                       "would write into " + job.directory + " as " + entry->second +
                           " does; give the problems different names");
  }
}

/// What is left of a job that is done.
struct Outcome {
  std::string problem;
  std::string status;
  Result result;
  int exit_status = kExitOk;
};

/// As the files stand or, where the user wants that and one cure is certain, as they would be
/// cured: the job then holds the cured files.
Result RunOrTryFix(bool try_fix, const Watch& watch, Job* job) {
  std::optional<CuredFiles> cured;
  Result result = Calibrate(job->spec, job->recording, watch, &cured);
  if (!try_fix || !cured) return result;
  job->spec = std::move(cured->spec);
  job->recording = std::move(cured->recording);
  job->spec.columns.clear();  // what is stored has the program's own names
  const auto as_cured = [&](Result again) {
    std::vector<SetupCause>& causes = again.setup.causes;
    causes.insert(causes.begin(), result.setup.causes.begin(), result.setup.causes.end());
    again.setup.cured = true;
    return again;
  };
  Watch watch_cured = watch;
  watch_cured.geometry = [&](const Result& geometry) { watch.geometry(as_cured(geometry)); };
  return as_cured(Calibrate(job->spec, job->recording, watch_cured));
}

/// What an interrupt says while nothing of a job is there.
std::string NothingWritten(const Job& job) {
  return "\nInterrupted; nothing was written of " + job.spec.name + ".\n";
}

/// Geometry that is there long before the diagnosis is written at once, and survives Ctrl-C.
void KeepGeometry(const Job& job, const Result& geometry, ProgressPrinter* printer) {
  SayOnInterrupt("\nInterrupted while the geometry was written: " + job.directory +
                 "/ holds it, or what was there before.\n");
  Diagnostics diagnostics;  // a folder that cannot be written is told at the end
  if (!WriteResult(job.spec, job.recording, geometry, job.directory, &diagnostics)) {
    SayOnInterrupt(NothingWritten(job));
    return;
  }
  const std::string where = "The geometry is in " + job.directory + "/";
  SayOnInterrupt("\nInterrupted. " + where + "; the search for left-out physics had not ended.\n");
  printer->Announce(Headline(geometry) + "\n" + where +
                    ". Now the search for left-out physics; Ctrl-C ends it and keeps the "
                    "geometry.\n");
}

/// The first screen, or the whole report.
void Print(bool verbose, const Job& job, const Result& result, const std::string& folder) {
  std::cout << ToText(verbose ? ReportOf(job.spec, job.recording, result)
                              : FirstScreenOf(result, folder))
            << std::flush;
  if (verbose && !folder.empty()) std::cout << "Results are in " << folder << "/\n" << std::flush;
}

/// Of several exit statuses the one that tells more than the others.
int Worse(int a, int b) {
  const auto rank = [](int status) {
    return status == kExitBadInput ? 3 : status == kExitNoUsableResult ? 2 : status != kExitOk;
  };
  return rank(a) >= rank(b) ? a : b;
}

/// Judges a usable result by what --accept asks, and says so: a refusal in any case.
void Accept(double limit, bool quiet, Outcome* outcome) {
  const Acceptance acceptance = JudgeAcceptance(outcome->result, limit);
  if (!acceptance.met) {
    std::cerr << outcome->problem << ": " << acceptance.sentence << ".\n";
    outcome->exit_status = kExitNotAccepted;
    outcome->status = "not accepted";
  } else if (!quiet) {
    std::cout << "  " << Capitalised(acceptance.sentence) << ".\n" << std::flush;
  }
}

Outcome RunJob(const CommandLine& command_line, Job* job) {
  const bool quiet = command_line.quiet;
  ProgressPrinter printer;
  Watch watch;
  if (!quiet) watch.progress = [&printer](const ProgressStep& step) { printer(step); };
  watch.geometry = [&](const Result& geometry) { KeepGeometry(*job, geometry, &printer); };
  SayOnInterrupt(NothingWritten(*job));
  Outcome outcome;
  outcome.problem = job->spec.name;
  outcome.result = RunOrTryFix(command_line.try_fix, watch, job);
  if (outcome.result.diagnosis && outcome.result.diagnosis->verdict == DiagnosisVerdict::kFailed) {
    std::cerr << job->spec.name << ": warning: " << outcome.result.diagnosis->summary << ".\n";
  }
  Diagnostics diagnostics;
  const bool written =
      WriteResult(job->spec, job->recording, outcome.result, job->directory, &diagnostics);
  // Printed when it is safe: who closes the pipe loses nothing.
  SayOnInterrupt("");
  if (!quiet) Print(command_line.verbose, *job, outcome.result, written ? job->directory : "");
  if (!written) {
    std::cerr << diagnostics.ToString();
    outcome.exit_status = kExitBadInput;
    outcome.status = "not written";
    return outcome;
  }
  const bool usable = outcome.result.best() != nullptr;
  outcome.exit_status = usable ? kExitOk : kExitNoUsableResult;
  outcome.status = usable ? "ok"
                   : !outcome.result.setup.plausible
                       ? "implausible"
                       : ToString(outcome.result.fits.front().termination);
  if (usable && command_line.accept) Accept(*command_line.accept, quiet, &outcome);
  // The table needs no rows, and many recordings' rows would not fit in memory together.
  outcome.result.residuals.clear();
  return outcome;
}

}  // namespace

int RunBatch(const CommandLine& command_line) {
  Diagnostics diagnostics;
  std::vector<Job> jobs;
  for (const std::string& file : command_line.problems) {
    // Each file's errors are found whatever the others hold.
    Diagnostics of_file;
    std::optional<Job> job = Prepare(command_line, file, &of_file);
    for (const Diagnostic& d : of_file.all()) {
      if (d.severity == Severity::kError || !command_line.quiet) diagnostics.Add(d);
    }
    if (job && of_file.ok()) jobs.push_back(std::move(*job));
  }
  CheckDirectoriesDiffer(jobs, &diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) {
    std::cerr << "ceres_dhcal: " << diagnostics.num_errors()
              << (diagnostics.num_errors() == 1 ? " error" : " errors")
              << " in the input; nothing was computed or written.\n";
    return kExitBadInput;
  }

  int exit_status = kExitOk;
  std::vector<Outcome> outcomes;
  for (Job& job : jobs) {
    outcomes.push_back(RunJob(command_line, &job));
    exit_status = Worse(exit_status, outcomes.back().exit_status);
  }
  if (jobs.size() > 1 && !command_line.quiet) {
    std::vector<SummaryRow> rows;
    for (const Outcome& outcome : outcomes) {
      rows.push_back({outcome.problem, outcome.status, &outcome.result});
    }
    std::cout << "\n" << ToText(SummaryTable(rows));
  }
  return exit_status;
}

}  // namespace dhcal
