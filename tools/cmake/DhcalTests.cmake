# The tests: one GoogleTest program per layer, each of its tests one CTest test <layer>/<name>.
#
# A test whose suite or name contains "Slow" gets the CTest label "slow": the test presets leave it
# out, `tools/test.sh --slow` and `ctest -L slow` run it.

include(GoogleTest)

dhcal_library(
  dhcal_test_support
  FOLDER tests/support
  DEPENDS dhcal_tools_support
          dhcal_tools_study
          dhcal_tools_transfer
          dhcal_tools_compensate
          dhcal_tools_compare
          dhcal_tools_convert
          dhcal_tools_plan
          dhcal_tools_proof
          GTest::gmock
          GTest::gtest)
target_compile_definitions(
  dhcal_test_support PUBLIC DHCAL_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                            DHCAL_PROGRAM="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/ceres_dhcal")

# dhcal_discover(<target> <prefix> <gtest filter> [<property> <value>]...)
function(dhcal_discover target prefix filter)
  gtest_discover_tests(
    ${target}
    TEST_PREFIX "${prefix}/"
    TEST_FILTER "${filter}"
    WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/tests"
    DISCOVERY_TIMEOUT 300
    NO_PRETTY_VALUES # names end with the parameter's own name, not with its bytes
    PROPERTIES ${ARGN})
endfunction()

# dhcal_shards(<target> <prefix>): the tests without "Slow" in a few processes. Sanitizers make a start
# cost as much as most tests take; what fails is in the output of its shard.
function(dhcal_shards target prefix)
  set(count 24)
  math(EXPR last "${count} - 1")
  foreach(shard RANGE ${last})
    set(name "${prefix}/shard_${shard}")
    add_test(NAME ${name} COMMAND ${target} "--gtest_filter=-*Slow*" --gtest_brief=1
             WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
    set_tests_properties(
      ${name} PROPERTIES TIMEOUT 900 ENVIRONMENT
                         "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# dhcal_tests(<layer> [FOLDER <folder of tests>] [WITHOUT <folder below it>] [DEPENDS <target>...])
function(dhcal_tests layer)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOLDER;WITHOUT" "DEPENDS")
  if(NOT arg_FOLDER)
    set(arg_FOLDER ${layer})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${arg_FOLDER}/*_test.cc")
  if(arg_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "/tests/${arg_FOLDER}/${arg_WITHOUT}/")
  endif()
  if(NOT sources)
    return()
  endif()
  set(target ${layer}_tests)
  add_executable(${target} ${sources})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
  target_link_libraries(${target} PRIVATE dhcal_test_support ${arg_DEPENDS} GTest::gmock_main
                                        dhcal_warnings)
  if(DHCAL_SANITIZE)
    dhcal_shards(${target} ${layer})
  else()
    dhcal_discover(${target} ${layer} "-*Slow*" TIMEOUT 300)
  endif()
  dhcal_discover(${target} ${layer} "*Slow*" TIMEOUT 3600 LABELS slow)
endfunction()

# The layers with the longest tests first: CTest starts tests in this order until it knows how long
# each takes, and a long one that starts last leaves all but one processor idle.
dhcal_tests(tools WITHOUT camera)
foreach(layer IN ITEMS problems residuals core)
  dhcal_tests(${layer})
endforeach()
if(DHCAL_CAMERA)
  dhcal_tests(camera FOLDER tools/camera DEPENDS dhcal_tools_camera)
endif()

# The checks of the source itself that are quick; format and clang-tidy: tools/test.sh.
add_test(NAME tools/layers COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tools/check_layers.py")
add_test(NAME tools/layers_self_test
         COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/check_layers_test.py")
add_test(NAME tools/build COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/build_test.py"
                                  "${CMAKE_COMMAND}")
add_test(NAME tools/citations
         COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tools/check_citations.py")
add_test(NAME tools/citations_self_test
         COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/check_citations_test.py")
# Sanitizers and coverage put symbols of their own into every object.
if(NOT DHCAL_SANITIZE AND NOT DHCAL_COVERAGE)
  add_test(NAME tools/simd_objects
           COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/simd_objects_test.py"
                   $<TARGET_OBJECTS:dhcal_core>
           COMMAND_EXPAND_LISTS)
endif()
# Installs this build, so only where all of it is built and none of it is instrumented.
if(NOT DHCAL_SANITIZE AND NOT DHCAL_COVERAGE)
  add_test(NAME tools/install
           COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/install_test.py"
                   "${CMAKE_COMMAND}" "${PROJECT_BINARY_DIR}")
endif()
# What the pages tell users to type. A sanitizer build has not all of the programs.
add_test(NAME problems/guides_self_test
         COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/problems/guides/guide_walk_test.py")
if(NOT DHCAL_SANITIZE AND NOT DHCAL_COVERAGE)
  add_test(NAME problems/guides
           COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/problems/guides/guides_test.py"
                   "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" ${programs})
endif()
# The loop of the paper runs most of the programs.
if(NOT DHCAL_SANITIZE AND NOT DHCAL_COVERAGE)
  add_test(NAME tools/paper_loop
           COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/tools/paper_loop_test.py"
                   "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
endif()
# The Python module, where it is built; else the test says that it skips.
if(DHCAL_PYTHON)
  set(python "${PYTHON_EXECUTABLE}")
else()
  set(python Python3::Interpreter)
endif()
add_test(NAME tools/python
         COMMAND "${python}" "${PROJECT_SOURCE_DIR}/tests/tools/python/dhcal_test.py"
                 "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" "${PROJECT_BINARY_DIR}/python"
                 "${DHCAL_PYTHON}")
set_tests_properties(tools/python PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: no Python module")
