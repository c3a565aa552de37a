# OpenCV's core, imgproc and imgcodecs for dhcal_ruler (tools/camera), where they are there. Nothing
# else needs them. Debian's packages of single modules ship no CMake files.

option(DHCAL_CAMERA "Build dhcal_ruler where OpenCV is there" ON)
if(DHCAL_CAMERA)
  find_path(OPENCV_INCLUDE_DIR opencv2/imgcodecs.hpp PATH_SUFFIXES opencv4)
  set(found "${OPENCV_INCLUDE_DIR}")
  foreach(module IN ITEMS core imgproc imgcodecs)
    find_library(OPENCV_${module}_LIBRARY opencv_${module})
    if(NOT OPENCV_${module}_LIBRARY)
      set(found OFF)
    endif()
  endforeach()
  if(found)
    foreach(module IN ITEMS core imgproc imgcodecs)
      add_library(opencv::${module} UNKNOWN IMPORTED)
      set_target_properties(
        opencv::${module} PROPERTIES IMPORTED_LOCATION "${OPENCV_${module}_LIBRARY}"
                                     INTERFACE_INCLUDE_DIRECTORIES "${OPENCV_INCLUDE_DIR}")
    endforeach()
  else()
    message(STATUS "OpenCV is not there: no dhcal_ruler")
    set(DHCAL_CAMERA OFF)
  endif()
endif()
