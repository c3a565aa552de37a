# The functions that make the libraries and the programs.

# dhcal_library(<target> FOLDER <folder> DEPENDS <target>...)
#
# A static library of all *.cc below <folder>. A folder that holds only headers, or nothing yet,
# gives a library of one generated empty source, so that the others can link it all the same.
function(dhcal_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOLDER" "DEPENDS")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.cc")
  if(NOT sources)
    set(sources "${PROJECT_BINARY_DIR}/generated/${target}_empty.cc")
    file(WRITE "${sources}.in" "// ${arg_FOLDER}/ holds no .cc file.\n")
    configure_file("${sources}.in" "${sources}" COPYONLY)
  endif()
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
  target_link_libraries(
    ${target}
    PUBLIC ${arg_DEPENDS}
    PRIVATE $<BUILD_INTERFACE:dhcal_warnings>)
  # A Python module is a shared object. The tests' own library is no part of it, and its precompiled
  # headers serve executables.
  if(DHCAL_PYTHON AND NOT target STREQUAL "dhcal_test_support")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  endif()
endfunction()

# dhcal_program(<name> DEPENDS <target>...)
#
# The program of tools/<name>.cc. A sanitizer build has only the one that tests run.
function(dhcal_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPENDS")
  add_executable(${name} "${PROJECT_SOURCE_DIR}/tools/${name}.cc")
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS} dhcal_warnings)
  if(DHCAL_SANITIZE AND NOT name STREQUAL "ceres_dhcal")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endfunction()
