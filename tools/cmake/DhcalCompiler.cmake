# The compiler: standard, optimisation, warnings, sanitizers, and what makes the build quick.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Release is CMake's own -O3 -DNDEBUG. No -march: a binary must run on other machines than its
# builder's. No -ffast-math: NaN means "not set" here. errno of the math functions is never read.
add_compile_options(-fno-math-errno)

add_library(dhcal_warnings INTERFACE)
target_compile_options(
  dhcal_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            -Wno-sign-conversion
            $<$<CXX_COMPILER_ID:Clang>:-Wreserved-identifier>
            $<$<BOOL:${DHCAL_WERROR}>:-Werror>)

# Four undefined-behaviour checks are left out. Three double the time to compile Eigen code, while a
# null pointer and an access past an object are the address sanitizer's business, too, and Eigen's
# own assertions see a misaligned map. The fourth blames Eigen for a block of an empty matrix.
if(DHCAL_SANITIZE)
  add_compile_options(
    -fsanitize=${DHCAL_SANITIZE}
    -fno-sanitize=null,alignment,object-size,pointer-overflow
    -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${DHCAL_SANITIZE})
  add_compile_definitions(_GLIBCXX_ASSERTIONS DHCAL_SANITIZED)
endif()

if(DHCAL_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()

# lld links several times faster than the default linker.
find_program(DHCAL_LLD ld.lld)
if(DHCAL_LLD AND NOT "${CMAKE_EXE_LINKER_FLAGS} ${CMAKE_CXX_FLAGS}" MATCHES "-fuse-ld=")
  add_link_options(-fuse-ld=lld)
endif()

# ccache, told to see two clones of this repository as the same code: paths below the clone are
# hashed relative to it. The sloppiness is what precompiled headers need.
find_program(DHCAL_CCACHE ccache)
if(DHCAL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND}"
      -E
      env
      "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
      CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros
      "${DHCAL_CCACHE}")
  if(DHCAL_PCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess) # else ccache does not see which one a file was compiled with
  endif()
endif()
