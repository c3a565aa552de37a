# The libraries, all from the distribution (tools/packages.txt; licences: third_party_notes).
# Imported targets' headers are system headers to the compiler: no warnings from them.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(gflags REQUIRED)
find_package(glog REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Boost 1.74 REQUIRED) # headers only: Boost.Math, Boost.Locale's UTF conversion

find_package(urdfdom_headers 1.0 REQUIRED)
find_package(console_bridge REQUIRED) # where urdfdom's messages go
find_package(urdfdom REQUIRED) # 3.0; its CMake files state no version
find_package(pugixml 1.12 REQUIRED)

# matio ships no CMake files.
find_path(MATIO_INCLUDE_DIR matio.h REQUIRED)
find_library(MATIO_LIBRARY matio REQUIRED)
if(NOT TARGET matio::matio)
  add_library(matio::matio UNKNOWN IMPORTED)
  set_target_properties(
    matio::matio PROPERTIES IMPORTED_LOCATION "${MATIO_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                                                                 "${MATIO_INCLUDE_DIR}")
endif()

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
