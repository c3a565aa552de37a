// Turns a set of names into findings: refitted together with the geometry, judged on rows that were
// not fitted, and put into words.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_FINDINGS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_FINDINGS_H_

#include <string>
#include <vector>

#include "core/model/diagnosis.h"
#include "problems/diagnosis/complete_fit.h"
#include "problems/diagnosis/unseen.h"

namespace dhcal {

/// True if two effects make one finding: the same one, or lines of one joint's gear.
bool OneFinding(const EffectRequest& a, const EffectRequest& b);

/// What all findings do together.
struct Totals {
  std::string validation_method;
  double rms_train_before = kUnknown, rms_train_after = kUnknown;  // [m]
  double rms_test_before = kUnknown, rms_test_after = kUnknown;    // [m]
};

struct DescribedFindings {
  std::vector<Finding> findings;
  Totals totals;
};

/// True if the test rows get worse by more than chance would let them were the effects real: the
/// gain of rows that an effect moves by s (in noise) has mean s's and variance 4 s's. Small effects
/// may lose on few rows by chance. A misread row has no say: its residual is cut. False without
/// test rows.
bool TestRowsSpeakAgainst(const CompleteFit& before, const CompleteFit& after);

/// Effects (positions in `effects`, the last ones among `after`'s) without which rows left out are
/// predicted better: the most harmful goes first, then the others are asked again without it.
std::vector<std::size_t> Unhelpful(const std::vector<EffectRequest>& effects,
                                   const CompleteFit& after);

/// Findings of `effects`, the last ones among `after`'s; `before` is the complete geometry alone
/// (and the problem file's own effects).
DescribedFindings DescribeFindings(const std::vector<EffectRequest>& effects,
                                   const CompleteFit& before,
                                   const CompleteFit& after);

/// Geometric parameters that the effects moved by more than their uncertainty, largest first.
std::vector<MovedParameter> MovedParameters(const CompleteFit& before, const CompleteFit& after);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_FINDINGS_H_
