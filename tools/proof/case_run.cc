#include "tools/proof/case_run.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/proof/run_program.h"

namespace dhcal {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char kAnswerHash[] = "sha256 of the sealed answer: ";

}  // namespace

CasePaths::CasePaths(const fs::path& folder, const std::string& name)
    : problem(folder / "cases" / name / "problem.yaml"),
      recording(folder / "cases" / name / "recording.csv"),
      answer(folder / "sealed" / (name + ".json")),
      result(folder / "results" / name),
      oracle_problem(folder / "oracle" / name / "problem.yaml"),
      oracle(folder / "oracle" / name / "result"),
      log(folder / "logs" / (name + ".txt")),
      oracle_log(folder / "logs" / (name + "_oracle.txt")) {}

void WriteWhole(const fs::path& file, const std::string& text) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  const fs::path aside = file.string() + ".part";
  {
    std::ofstream stream(aside, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error("cannot write " + aside.string());
  }
  fs::rename(aside, file);
}

std::string ReadAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

Json ReadJson(const fs::path& file) {
  return Json::parse(ReadAll(file), nullptr, /*allow_exceptions=*/false);
}

bool IsMade(const CasePaths& paths) {
  return fs::exists(paths.problem) && fs::exists(paths.recording) && fs::exists(paths.answer);
}

void WriteCase(const concealed::CaseFiles& files, const CasePaths& paths) {
  WriteWhole(paths.answer, files.answer);
  WriteWhole(paths.recording, files.recording);
  WriteWhole(paths.problem, files.problem);
}

std::string RunCase(const fs::path& program,
                    const fs::path& problem,
                    const fs::path& out,
                    const fs::path& log) {
  if (fs::exists(out / "result.json")) return "";
  fs::create_directories(log.parent_path());
  fs::create_directories(out.parent_path());
  const int status =
      RunProgram(program, {"--problem", problem.string(), "--out", out.string(), "--quiet"}, log);
  if (status == 0) return "";
  return fmt::format(
      "{} ended with status {}; see {}", program.filename().string(), status, log.string());
}

std::string OpenAnswer(const CasePaths& paths, Json* answer) {
  const std::string text = ReadAll(paths.answer);
  const std::string problem = ReadAll(paths.problem);
  if (problem.find(kAnswerHash + concealed::Sha256(text)) == std::string::npos) {
    return fmt::format("{} is not the answer that {} names by its hash",
                       paths.answer.string(),
                       paths.problem.string());
  }
  *answer = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return answer->is_discarded() ? paths.answer.string() + " is no JSON" : "";
}

std::string RunAndOpen(const fs::path& program,
                       const CasePaths& paths,
                       Json* result,
                       Json* answer) {
  std::string wrong = RunCase(program, paths.problem, paths.result, paths.log);
  if (wrong.empty()) wrong = OpenAnswer(paths, answer);
  if (!wrong.empty()) return wrong;
  *result = ReadJson(paths.result / "result.json");
  return result->is_discarded() ? "result.json is no JSON" : "";
}

void ForgetOtherPrograms(const fs::path& folder, const fs::path& program) {
  const fs::path mark = folder / "program.sha256";
  const std::string now = concealed::Sha256(ReadAll(program)) + "\n";
  if (fs::exists(mark) && ReadAll(mark) == now) return;
  for (const char* const part : {"results", "oracle", "logs"}) {
    fs::remove_all(folder / part);
  }
  WriteWhole(mark, now);
}

}  // namespace dhcal
