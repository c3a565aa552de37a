# Precompiles what most files include: two sets, without and with GoogleTest. A fifth of the time to
# build. A file that lacks an include compiles with this: the `dev` build, of single files and without
# it, shows that; of the standard library cpplint does.

set(headers
    <algorithm>
    <cmath>
    <functional>
    <map>
    <memory>
    <optional>
    <string>
    <utility>
    <vector>
    <Eigen/Core>
    <Eigen/Geometry>
    <fmt/format.h>)

target_precompile_headers(dhcal_core PRIVATE ${headers})
foreach(target IN ITEMS dhcal_residuals dhcal_problems dhcal_tools_support dhcal_tools_study
                      dhcal_tools_transfer dhcal_tools_compensate dhcal_tools_compare
                      dhcal_tools_convert dhcal_tools_plan
                      dhcal_tools_proof dhcal_tools_camera)
  if(TARGET ${target}) # the proof's, only with OpenSSL; the camera's, with OpenCV
    target_precompile_headers(${target} REUSE_FROM dhcal_core)
  endif()
endforeach()

if(DHCAL_BUILD_TESTS)
  target_precompile_headers(
    dhcal_test_support
    PRIVATE
    ${headers}
    <gmock/gmock.h>
    <gtest/gtest.h>)
  foreach(target IN ITEMS core_tests residuals_tests problems_tests tools_tests camera_tests)
    if(TARGET ${target})
      target_precompile_headers(${target} REUSE_FROM dhcal_test_support)
    endif()
  endforeach()
endif()
