// The random group as a folder: makes its cases, runs the program on them, opens the seals. The
// folder is that of the scenarios (suite.h).
#ifndef DHCAL_TOOLS_PROOF_RANDOM_SUITE_H_
#define DHCAL_TOOLS_PROOF_RANDOM_SUITE_H_

#include <functional>
#include <vector>

#include "tools/proof/random_score.h"
#include "tools/proof/suite.h"

namespace dhcal {

/// Makes, runs and scores `options.random` trials from seed `options.first` on; `say` gets the
/// number of those done. A case that cannot be scored says why in `failure`.
std::vector<RandomScore> RunRandomProof(const ProofOptions& options,
                                        const std::function<void(int done, int all)>& say);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_PROOF_RANDOM_SUITE_H_
