#include "core/simd/level.h"

#include <cstdlib>

#include <glog/logging.h>

namespace dhcal::simd {
namespace {

#if defined(__x86_64__)
bool HasAvx2() { return __builtin_cpu_supports("avx2") != 0; }
bool HasAvx512() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
}
#else
bool HasAvx2() { return false; }
bool HasAvx512() { return false; }
#endif

std::vector<const Kernels*> FindSupported() {
  std::vector<const Kernels*> kernels{kBaselineKernels};
  if (kAvx2Kernels != nullptr && HasAvx2()) kernels.push_back(kAvx2Kernels);
  if (kAvx512Kernels != nullptr && HasAvx512()) kernels.push_back(kAvx512Kernels);
  return kernels;
}

const Kernels* Choose() {
  const char* wanted = std::getenv("DHCAL_SIMD");
  if (wanted == nullptr || *wanted == '\0') return SupportedKernels().back();
  if (const Kernels* kernels = FindKernels(wanted)) return kernels;
  LOG(WARNING) << "DHCAL_SIMD=" << wanted << " is no SIMD level of this processor; using "
               << SupportedKernels().back()->name;
  return SupportedKernels().back();
}

}  // namespace

const std::vector<const Kernels*>& SupportedKernels() {
  static const std::vector<const Kernels*> supported = FindSupported();
  return supported;
}

const Kernels* FindKernels(const std::string& name) {
  for (const Kernels* kernels : SupportedKernels()) {
    if (name == kernels->name) return kernels;
  }
  return nullptr;
}

const Kernels& ActiveKernels() {
  static const Kernels* active = Choose();
  return *active;
}

}  // namespace dhcal::simd
