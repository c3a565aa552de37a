// A trial as files: what the program gets, and the sealed answer.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_CASE_FILES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_CASE_FILES_H_

#include <string>

#include "tools/proof/simulator/trial.h"

namespace dhcal::concealed {

struct CaseFiles {
  std::string name;       // "D4_kr15_01"
  std::string problem;    // problem.yaml; names the hash of the answer
  std::string recording;  // recording.csv
  std::string answer;     // JSON, to be kept elsewhere
};

/// The answer holds the causes, their visibility, the true error elsewhere and, where the library
/// has all causes, the problem file of the oracle: the same fit, told the truth.
CaseFiles FilesOf(const Trial& trial);

/// SHA-256 in hexadecimal digits.
std::string Sha256(const std::string& text);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_CASE_FILES_H_
