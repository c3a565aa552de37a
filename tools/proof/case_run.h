// One case of the proof in its folder: made, run, and opened.
#ifndef DHCAL_TOOLS_PROOF_CASE_RUN_H_
#define DHCAL_TOOLS_PROOF_CASE_RUN_H_

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/proof/simulator/case_files.h"

namespace dhcal {

struct CasePaths {
  CasePaths(const std::filesystem::path& folder, const std::string& name);

  std::filesystem::path problem, recording, answer, result, oracle_problem, oracle, log, oracle_log;
};

/// Writes a file whole or not at all, with its folder: a stopped run leaves no half file. Throws
/// std::runtime_error when it cannot.
void WriteWhole(const std::filesystem::path& file, const std::string& text);

std::string ReadAll(const std::filesystem::path& file);

/// Discarded where the file is no JSON.
nlohmann::json ReadJson(const std::filesystem::path& file);

bool IsMade(const CasePaths& paths);
void WriteCase(const concealed::CaseFiles& files, const CasePaths& paths);

/// Runs the program, unless its result is there; "" or why it gave none.
std::string RunCase(const std::filesystem::path& program,
                    const std::filesystem::path& problem,
                    const std::filesystem::path& out,
                    const std::filesystem::path& log);

/// Opens the seal: only after the program has answered. "" or why it cannot be trusted.
std::string OpenAnswer(const CasePaths& paths, nlohmann::json* answer);

/// Runs the program on a case, then opens its seal; "" or why there is nothing to score.
std::string RunAndOpen(const std::filesystem::path& program,
                       const CasePaths& paths,
                       nlohmann::json* result,
                       nlohmann::json* answer);

/// Results of another build of the program are not its own.
void ForgetOtherPrograms(const std::filesystem::path& folder, const std::filesystem::path& program);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_CASE_RUN_H_
