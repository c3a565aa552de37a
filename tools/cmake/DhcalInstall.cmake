# What `cmake --install` lays where, and the Debian packages (`cpack -G DEB`): component `runtime`
# (programs, man pages, completion, templates, cases) and `development` (headers, libraries,
# find_package). What needs OpenCV or Python is a component of its own and in no package, so that the
# packages do not need them. Judges of the program are no part of it.

set(packaging "${PROJECT_SOURCE_DIR}/tools/packaging")
set(programs ceres_dhcal dhcal_simulate dhcal_compensate dhcal_compare dhcal_convert dhcal_plan)
set(share "${CMAKE_INSTALL_DATADIR}/ceres_dhcal")
set(doc "${CMAKE_INSTALL_DATADIR}/doc/ceres-dhcal")

# Programs, and what they read.
install(TARGETS ${programs} RUNTIME COMPONENT runtime)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/problems/robots" DESTINATION "${share}" COMPONENT runtime
        FILES_MATCHING PATTERN "*.yaml")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/problems/cases" DESTINATION "${share}" COMPONENT runtime
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.csv" PATTERN "concealed" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
        DESTINATION "${doc}" COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/problems/FORMATS.md" DESTINATION "${doc}/problems"
        COMPONENT runtime)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/problems/guides" DESTINATION "${doc}/problems"
        COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${doc}" RENAME copyright
        COMPONENT runtime)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/third_party_notes" DESTINATION "${doc}" COMPONENT runtime)
if(DHCAL_CAMERA)
  install(TARGETS dhcal_ruler RUNTIME COMPONENT camera)
  list(APPEND programs dhcal_ruler)
endif()
# component_of(<variable> <program>)
function(component_of variable program)
  set(component runtime)
  if(program STREQUAL "dhcal_ruler")
    set(component camera)
  endif()
  set(${variable} ${component} PARENT_SCOPE)
endfunction()
set(completions "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
foreach(program IN LISTS programs)
  component_of(component ${program})
  install(FILES "${packaging}/completion.bash" DESTINATION "${completions}" RENAME "${program}"
          COMPONENT ${component})
endforeach()

# Man pages, where help2man is there.
find_program(DHCAL_HELP2MAN help2man)
if(DHCAL_HELP2MAN)
  set(pages)
  foreach(program IN LISTS programs)
    set(page "${PROJECT_BINARY_DIR}/man/${program}.1")
    add_custom_command(
      OUTPUT "${page}"
      COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:${program}>"
              "-DVERSION=${PROJECT_VERSION}" "-DHELP2MAN=${DHCAL_HELP2MAN}" "-DPAGE=${page}"
              -P "${packaging}/man_page.cmake"
      DEPENDS ${program} "${packaging}/man_page.cmake"
      VERBATIM)
    list(APPEND pages "${page}")
    component_of(component ${program})
    install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT ${component})
  endforeach()
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/man")
  add_custom_target(dhcal_man_pages ALL DEPENDS ${pages})
else()
  message(STATUS "help2man is not there: no man pages")
endif()

# Libraries and headers, for find_package(ceres_dhcal).
foreach(layer IN ITEMS core residuals problems)
  set_target_properties(dhcal_${layer} PROPERTIES EXPORT_NAME ${layer})
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${layer}"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ceres_dhcal" COMPONENT development
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(
  TARGETS dhcal_core dhcal_residuals dhcal_problems
  EXPORT ceres_dhcalTargets
  ARCHIVE COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ceres_dhcal")
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/ceres_dhcal")
install(EXPORT ceres_dhcalTargets NAMESPACE ceres_dhcal:: DESTINATION "${package_folder}"
        COMPONENT development)
include(CMakePackageConfigHelpers)
configure_package_config_file(
  "${packaging}/ceres_dhcalConfig.cmake.in" "${PROJECT_BINARY_DIR}/ceres_dhcalConfig.cmake"
  INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/ceres_dhcalConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/ceres_dhcalConfig.cmake"
        "${PROJECT_BINARY_DIR}/ceres_dhcalConfigVersion.cmake"
        "${PROJECT_SOURCE_DIR}/tools/cmake/DhcalMatio.cmake"
  DESTINATION "${package_folder}" COMPONENT development)

# Debian packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ceres-dhcal)
set(CPACK_PACKAGE_CONTACT "the maintainers of ceres_dhcal <nobody@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ceres-dhcal)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ceres-dhcal-dev)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "ceres-dhcal, libceres-dev, libeigen3-dev, libgoogle-glog-dev, libyaml-cpp-dev, nlohmann-json3-dev, libmatio-dev, libfmt-dev, libboost-math-dev")
find_program(DHCAL_SHLIBDEPS dpkg-shlibdeps) # which libraries the programs need
if(DHCAL_SHLIBDEPS)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
