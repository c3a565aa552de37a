// Which of the compiled kernels run on this processor (SIMD.md).
#ifndef DHCAL_CORE_SIMD_LEVEL_H_
#define DHCAL_CORE_SIMD_LEVEL_H_

#include <string>
#include <vector>

#include "core/simd/kernels.h"

namespace dhcal::simd {

/// Those that this processor can run, slowest first; the baseline always.
const std::vector<const Kernels*>& SupportedKernels();

/// The one of that name; null where this processor cannot run it.
const Kernels* FindKernels(const std::string& name);

/// The fastest, or what the environment variable DHCAL_SIMD (baseline, avx2, avx512) names, read
/// once. A name that is unknown here is reported in the log and not followed: results are the same.
const Kernels& ActiveKernels();

}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_LEVEL_H_
