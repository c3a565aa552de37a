# The compile options of the SIMD kernels, one source per level (core/simd/SIMD.md).
#
# No contraction of a * b + c into one rounding: results must be the same bits on every level.

include(CheckCXXCompilerFlag)

set(DHCAL_AVX512_FLAGS -mavx512f -mavx512dq -mavx512vl)
check_cxx_compiler_flag("-mavx2" DHCAL_HAS_AVX2)
check_cxx_compiler_flag("-mavx512f -mavx512dq -mavx512vl" DHCAL_HAS_AVX512)

# dhcal_simd_level(<level> <option>...)
function(dhcal_simd_level level)
  set_source_files_properties(
    "${PROJECT_SOURCE_DIR}/core/simd/kernels_${level}.cc"
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
               SKIP_PRECOMPILE_HEADERS ON
               COMPILE_OPTIONS "-ffp-contract=off;${ARGN}")
endfunction()

dhcal_simd_level(baseline)
if(DHCAL_HAS_AVX2)
  dhcal_simd_level(avx2 -mavx2)
else()
  dhcal_simd_level(avx2)
endif()
if(DHCAL_HAS_AVX512)
  dhcal_simd_level(avx512 ${DHCAL_AVX512_FLAGS})
else()
  dhcal_simd_level(avx512)
endif()

# What the benchmark compares with may use all that the building machine has.
check_cxx_compiler_flag("-march=native" DHCAL_HAS_MARCH_NATIVE)
set_source_files_properties("${PROJECT_SOURCE_DIR}/tools/bench/bare_kernel.cc"
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
if(DHCAL_HAS_MARCH_NATIVE)
  set_source_files_properties("${PROJECT_SOURCE_DIR}/tools/bench/bare_kernel.cc"
                              PROPERTIES COMPILE_OPTIONS "-march=native")
endif()
