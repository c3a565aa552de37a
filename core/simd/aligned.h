// Doubles at the alignment that the kernels like best.
#ifndef DHCAL_CORE_SIMD_ALIGNED_H_
#define DHCAL_CORE_SIMD_ALIGNED_H_

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "core/simd/kernels.h"

namespace dhcal::simd {

/// Allocates at kAlignment.
template <typename T>
struct AlignedAllocator {
  using value_type = T;

  AlignedAllocator() = default;
  template <typename U>
  explicit AlignedAllocator(const AlignedAllocator<U>& /*other*/) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{kAlignment}));
  }
  void deallocate(T* memory, std::size_t /*count*/) {
    ::operator delete (memory, std::align_val_t{kAlignment});
  }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
  friend bool operator!=(const AlignedAllocator&, const AlignedAllocator&) { return false; }
};

using AlignedDoubles = std::vector<double, AlignedAllocator<double>>;

}  // namespace dhcal::simd

#endif  // DHCAL_CORE_SIMD_ALIGNED_H_
