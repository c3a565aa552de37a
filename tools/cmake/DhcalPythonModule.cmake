# The Python module dhcal: tools/dhcal_python.cc and what makes it pleasant beside it. Of the build it
# is <build>/python/dhcal.

pybind11_add_module(dhcal_python MODULE NO_EXTRAS "${PROJECT_SOURCE_DIR}/tools/dhcal_python.cc")
target_link_libraries(dhcal_python PRIVATE dhcal_tools_compensate dhcal_warnings)
set_target_properties(
  dhcal_python PROPERTIES OUTPUT_NAME _dhcal
                          LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/python/dhcal")
configure_file("${PROJECT_SOURCE_DIR}/tools/python/dhcal/__init__.py"
               "${PROJECT_BINARY_DIR}/python/dhcal/__init__.py" COPYONLY)

set(DHCAL_PYTHON_INSTALL_DIR
    "${CMAKE_INSTALL_LIBDIR}/python${PYTHON_VERSION_MAJOR}.${PYTHON_VERSION_MINOR}/site-packages"
    CACHE STRING "Where the module dhcal is installed, below the prefix")
install(TARGETS dhcal_python LIBRARY DESTINATION "${DHCAL_PYTHON_INSTALL_DIR}/dhcal"
        COMPONENT python)
install(FILES "${PROJECT_SOURCE_DIR}/tools/python/dhcal/__init__.py"
        DESTINATION "${DHCAL_PYTHON_INSTALL_DIR}/dhcal" COMPONENT python)
