# The Python module dhcal (tools/python): for the first Python 3 that has numpy and its headers, where pybind11 is
# there, too. Nothing else needs it. Before any other search for Python, which pybind11 would take.

set(DHCAL_PYTHON OFF)
find_program(DHCAL_PYTHON3 python3)
if(NOT DHCAL_SANITIZE AND NOT DHCAL_COVERAGE)
  foreach(candidate IN ITEMS "${DHCAL_PYTHON3}" /usr/bin/python3)
    execute_process(
      COMMAND "${candidate}" -c
              "import numpy, os, sysconfig; open(os.path.join(sysconfig.get_path('include'), 'Python.h'))"
      RESULT_VARIABLE lacks OUTPUT_QUIET ERROR_QUIET)
    if(lacks STREQUAL "0")
      set(PYTHON_EXECUTABLE "${candidate}" CACHE FILEPATH "Python 3 that the module dhcal is for")
      find_package(pybind11 2.10 QUIET CONFIG)
      if(pybind11_FOUND)
        set(DHCAL_PYTHON ON)
      endif()
      break()
    endif()
  endforeach()
  if(NOT DHCAL_PYTHON)
    message(STATUS "pybind11, numpy or Python's headers are not there: no Python module")
  endif()
endif()
