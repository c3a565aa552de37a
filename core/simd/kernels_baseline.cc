// The kernels for every processor of the architecture (SIMD.md).
#define DHCAL_SIMD_WIDTH 2
#include "core/simd/gram_kernel.h"
#include "core/simd/kernels.h"
#include "core/simd/pose_tile_kernel.h"
#include "core/simd/product_kernel.h"
#include "core/simd/substitute_kernel.h"

namespace dhcal::simd {
namespace {

constexpr Kernels kKernels = {"baseline", EvaluatePoseTile, Substitute, Gram, Cross, Deduct};

}  // namespace

const Kernels* const kBaselineKernels = &kKernels;

}  // namespace dhcal::simd
