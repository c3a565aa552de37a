// The kernels for processors with AVX-512 F, DQ and VL (SIMD.md).
#include "core/simd/kernels.h"

// Set by this source's own compile options (tools/cmake/DhcalSimd.cmake).
#ifdef __AVX512F__

#define DHCAL_SIMD_WIDTH 8
#include "core/simd/gram_kernel.h"
#include "core/simd/pose_tile_kernel.h"
#include "core/simd/product_kernel.h"
#include "core/simd/substitute_kernel.h"

namespace dhcal::simd {
namespace {

constexpr Kernels kKernels = {"avx512", EvaluatePoseTile, Substitute, Gram, Cross, Deduct};

}  // namespace

const Kernels* const kAvx512Kernels = &kKernels;

}  // namespace dhcal::simd

#else

namespace dhcal::simd {

const Kernels* const kAvx512Kernels = nullptr;

}  // namespace dhcal::simd

#endif
