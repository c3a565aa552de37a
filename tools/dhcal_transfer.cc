// Does the physics that a diagnosis finds hold on rows, and on a recording, that it never saw?
//
//   dhcal_transfer FIRST.yaml [SECOND.yaml] [blocks] [unseen blocks]        (default 10 and 0)
//
// Diagnoses the first problem's recording. Then prints the 3-D RMS error of the predicted points
// [mm], with the complete geometry alone and with the physics:
//   - over blocks of consecutive rows, each predicted from the other blocks (the search saw them;
//     geometry and effects are estimated without the block);
//   - over the last few blocks again, if asked for, each with a diagnosis of its own that never saw
//     the block;
//   - over the second recording (another day, the same robot) with the physics held at the first's
//     values and geometry, base and tool fitted: all rows, those inside and outside of the first's
//     joint ranges, and those of which every joint has been within 2 deg of that angle.
// DHCAL_DATA names the folder of recordings, as for ceres_dhcal.
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/quiet_log.h"
#include "core/base/units.h"
#include "problems/diagnosis/diagnose.h"
#include "problems/formats/problem/problem_checks.h"
#include "problems/formats/problem/problem_reader.h"
#include "problems/formats/recording/recording_reader.h"
#include "problems/identify.h"
#include "problems/simulate.h"
#include "tools/transfer/transfer.h"

namespace dhcal {
namespace {

struct Input {
  ProblemSpec spec;
  Recording recording;
};

std::optional<Input> Read(const std::string& file, Diagnostics* diagnostics) {
  const char* const data = std::getenv("DHCAL_DATA");
  std::optional<ProblemSpec> spec = ReadProblemFile(file, data == nullptr ? "" : data, diagnostics);
  if (!spec) return std::nullopt;
  std::optional<Recording> recording =
      spec->simulate
          ? SimulateRecording(*spec, diagnostics)
          : ReadRecording(spec->recording, spec->robot.joints, spec->columns, diagnostics);
  if (!recording) return std::nullopt;
  CheckRecordingFits(*spec, *recording, diagnostics);
  return Input{std::move(*spec), std::move(*recording)};
}

void Print(const std::string& what, const Errors& errors) {
  std::cout << fmt::format("  {:<48} {:6d} rows  {:8.4f} mm -> {:8.4f} mm\n",
                           what,
                           errors.rows,
                           errors.before / kMillimetre,
                           errors.after / kMillimetre)
            << std::flush;
}

void PrintModel(const std::vector<EffectRequest>& model) {
  for (const EffectRequest& effect : model) std::cout << "    " << InstanceName(effect) << "\n";
  if (model.empty()) std::cout << "    nothing\n";
}

void PrintBlocks(const Input& first, const std::vector<EffectRequest>& model, int blocks) {
  std::cout
      << "Blocks of consecutive rows, estimated without the block (3-D RMS, geometry alone -> "
         "with the physics)\n";
  const std::vector<Errors> errors = PredictBlocks(first.spec, first.recording, model, blocks, {});
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) {
    Print(fmt::format("block {} of {}", k + 1, blocks), errors[k]);
  }
  if (!errors.empty()) Print("all", errors.back());
}

void PrintUnseen(const Input& first, int blocks, int unseen) {
  std::cout << "Blocks that neither search nor fits saw\n";
  for (int block = blocks - unseen; block < blocks; ++block) {
    const UnseenBlock result = DiagnoseWithoutBlock(first.spec, first.recording, block, blocks, {});
    Print(fmt::format("block {} of {}, found without it:", block + 1, blocks), result.errors);
    PrintModel(result.model);
  }
}

void PrintTransfer(const Input& first,
                   const Input& second,
                   const std::vector<EffectRequest>& model) {
  const Transfer transfer = TransferTo(second.spec, second.recording, first.recording, model, {});
  std::cout << "The second recording, physics held, geometry, base and tool fitted again\n";
  Print("all rows", transfer.all);
  Print("inside the first's joint ranges", transfer.inside);
  Print("outside of them", transfer.outside);
  Print("every joint has been within 2 deg of its angle", transfer.visited);
  for (const std::string& name : transfer.left_behind) {
    std::cout << "  not carried over: " << name << "\n";
  }
}

int Run(const std::vector<std::string>& files, int blocks, int unseen) {
  Diagnostics diagnostics;
  std::vector<Input> inputs;
  for (const std::string& file : files) {
    if (std::optional<Input> input = Read(file, &diagnostics)) inputs.push_back(std::move(*input));
  }
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return 2;
  const Input& first = inputs.front();
  const Result identified = IdentifyGeometry(first.spec, first.recording, {});
  const DiagnosisResult d = Diagnose(first.spec, first.recording, identified, {});
  std::cout << fmt::format("{}: {} in {:.1f} s\n", first.spec.name, ToString(d.verdict), d.seconds);
  PrintModel(d.model);
  PrintBlocks(first, d.model, blocks);
  if (unseen > 0) PrintUnseen(first, blocks, unseen);
  if (inputs.size() > 1) PrintTransfer(first, inputs[1], d.model);
  return 0;
}

/// True for a text of digits; reads it.
bool IsNumber(const std::string& text, int* number) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return false;
  *number = std::atoi(text.c_str());
  return true;
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  dhcal::StartQuietLog(argv[0]);
  std::vector<std::string> files;
  std::vector<int> numbers;
  for (int k = 1; k < argc; ++k) {
    int number = 0;
    if (dhcal::IsNumber(argv[k], &number)) {
      numbers.push_back(number);
    } else {
      files.emplace_back(argv[k]);
    }
  }
  const int blocks = numbers.empty() ? 10 : numbers[0];
  const int unseen = numbers.size() > 1 ? numbers[1] : 0;
  const bool flag = !files.empty() && files.front().rfind('-', 0) == 0;  // such as --help
  if (files.empty() || flag || files.size() > 2 || blocks < 2 || unseen > blocks) {
    std::cerr << "usage: dhcal_transfer FIRST.yaml [SECOND.yaml] [blocks >= 2] [unseen blocks]\n";
    return 2;
  }
  return dhcal::Run(files, blocks, unseen);
}
