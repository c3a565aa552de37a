# The libraries, all from the distribution (tools/packages.txt; licences: third_party_notes).
# Imported targets' headers are system headers to the compiler: no warnings from them.

# Name and least version of each; the installed find_package(ceres_dhcal) looks for the same.
set(DHCAL_PACKAGES
    "Threads"
    "Eigen3 3.4 NO_MODULE"
    "Ceres 2.1"
    "glog"
    "yaml-cpp 0.7"
    "nlohmann_json 3.11"
    "fmt 9"
    "Boost 1.74" # headers only: Boost.Math, Boost.Locale's UTF conversion
    "urdfdom_headers 1.0"
    "console_bridge" # where urdfdom's messages go
    "urdfdom" # 3.0; its CMake files state no version
    "pugixml 1.12")
foreach(package IN LISTS DHCAL_PACKAGES)
  separate_arguments(words UNIX_COMMAND "${package}")
  find_package(${words} REQUIRED)
endforeach()
find_package(gflags REQUIRED) # of the command line alone
include(DhcalMatio)

# yaml-cpp has its namespaced target only since 0.8.
if(NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

set(DHCAL_DEPENDENCIES
    Ceres::ceres
    Eigen3::Eigen
    glog::glog
    yaml-cpp::yaml-cpp
    matio::matio
    nlohmann_json::nlohmann_json
    fmt::fmt
    Boost::headers
    urdfdom::urdfdom_model
    console_bridge::console_bridge
    pugixml::pugixml
    Threads::Threads)

# SHA-256 of the proof's sealed answers. The program needs it not; the tests must not go without the
# proof's and say nothing.
if(DHCAL_BUILD_TESTS)
  find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto)
  find_package(GTest REQUIRED) # with GMock
  find_package(Python3 REQUIRED COMPONENTS Interpreter) # for the layer check
else()
  find_package(OpenSSL 3.0 QUIET COMPONENTS Crypto)
endif()
if(NOT OpenSSL_FOUND)
  message(STATUS "OpenSSL 3 is not there: no dhcal_prove")
endif()
