# Debian packages by CPack, from `make deb`: `meniscus` of the component program, `libmeniscus-dev` of
# the component development. What `meniscus` needs is found by dpkg-shlibdeps. `libmeniscus-dev` needs
# the -dev packages that the build needs (scripts/setup.sh has the list), of the same minor version:
# archives and headers fit no other.
find_program(DPKG_QUERY dpkg-query)
if(NOT DPKG_QUERY)
  return()
endif()

file(READ ${PROJECT_SOURCE_DIR}/scripts/setup.sh SETUP)
string(REGEX MATCH "\nbuild=\\(([^)]*)\\)" FOUND "${SETUP}")
string(REGEX MATCHALL "[a-z0-9.+-]+" BUILD_PACKAGES "${CMAKE_MATCH_1}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scripts/setup.sh)
set(DEVELOPMENT_DEPENDS pkgconf)
foreach(PACKAGE ${BUILD_PACKAGES})
  if(NOT PACKAGE MATCHES "-dev$")
    continue()
  endif()
  execute_process(COMMAND ${DPKG_QUERY} -W -f=\${Version} ${PACKAGE}
    OUTPUT_VARIABLE VERSION ERROR_QUIET RESULT_VARIABLE FAILED)
  if(FAILED OR NOT VERSION MATCHES "^(([0-9]+:)?[0-9]+)\\.([0-9]+)")
    list(APPEND DEVELOPMENT_DEPENDS ${PACKAGE})
    continue()
  endif()
  math(EXPR NEXT "${CMAKE_MATCH_3} + 1")
  list(APPEND DEVELOPMENT_DEPENDS "${PACKAGE} (>= ${CMAKE_MATCH_1}.${CMAKE_MATCH_3})"
    "${PACKAGE} (<< ${CMAKE_MATCH_1}.${NEXT}~)")
endforeach()
list(JOIN DEVELOPMENT_DEPENDS ", " DEVELOPMENT_DEPENDS)

foreach(PACKAGE_OF_COMPONENT "program:meniscus" "development:libmeniscus-dev")
  string(REPLACE ":" ";" PAIR ${PACKAGE_OF_COMPONENT})
  list(GET PAIR 0 COMPONENT)
  list(GET PAIR 1 PACKAGE)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${PACKAGE} COMPONENT ${COMPONENT})
  string(TOUPPER ${COMPONENT} UPPER)
  set(CPACK_DEBIAN_${UPPER}_PACKAGE_NAME ${PACKAGE})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME meniscus)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Meniscus developers")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/deb)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
if(MENISCUS_HAS_PYTHON)
  math(EXPR NEXT "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${NEXT}), python3-numpy")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openmpi-bin, libopenblas0, fonts-dejavu-core, nodejs (>= 18), ffmpeg, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libmeniscus-dev, paraview")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Deforming liquid drops with a sharp, conforming interface
 Simulates drops in another flowing liquid, by finite elements on
 tetrahedral meshes whose faces are the interface, and by boundary
 integrals: deformation, breakup, coalescence, surfactants, heat,
 species and inertia.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${DEVELOPMENT_DEPENDS}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Library of Meniscus, to build programs with
 Headers, static archives and a CMake package: surface remeshing,
 tetrahedral meshes that conform to interfaces, Stokes and
 Navier-Stokes flow of two liquids, boundary integrals.")
include(CPack)
