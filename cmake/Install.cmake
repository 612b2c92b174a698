# The program, and the package meniscus that exports meniscus::meniscus: every room but the program's.
# Component `program` is what users get, `development` what programs of others are built with.
include(CMakePackageConfigHelpers)
set(PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/meniscus)

get_property(ROOMS GLOBAL PROPERTY MENISCUS_ROOMS)
list(REMOVE_ITEM ROOMS meniscus_app)
add_library(meniscus INTERFACE)
add_library(meniscus::meniscus ALIAS meniscus)
target_link_libraries(meniscus INTERFACE ${ROOMS})

install(TARGETS meniscus ${ROOMS} EXPORT meniscusTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/meniscus ${PROJECT_BINARY_DIR}/generated/meniscus
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/meniscusConfig.cmake.in
  ${PROJECT_BINARY_DIR}/meniscusConfig.cmake INSTALL_DESTINATION ${PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meniscusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT meniscusTargets NAMESPACE meniscus:: DESTINATION ${PACKAGE_DIR} COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/meniscusConfig.cmake
  ${PROJECT_BINARY_DIR}/meniscusConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake
  DESTINATION ${PACKAGE_DIR} COMPONENT development)

# The program writes its own manual page and completion. (Leaks of Open MPI are not their concern.)
set(REFERENCE_DIR ${PROJECT_BINARY_DIR}/reference)
file(MAKE_DIRECTORY ${REFERENCE_DIR})
set(WRITE ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:meniscus_program>)
add_custom_command(OUTPUT ${REFERENCE_DIR}/meniscus.1.gz ${REFERENCE_DIR}/meniscus
  COMMAND ${WRITE} manual > meniscus.1
  COMMAND gzip -9 -n -f meniscus.1
  COMMAND ${WRITE} completion > meniscus
  DEPENDS meniscus_program WORKING_DIRECTORY ${REFERENCE_DIR}
  COMMENT "Writing the manual page and the completion" VERBATIM)
add_custom_target(meniscus_reference ALL
  DEPENDS ${REFERENCE_DIR}/meniscus.1.gz ${REFERENCE_DIR}/meniscus)

install(TARGETS meniscus_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(FILES ${REFERENCE_DIR}/meniscus.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
  COMPONENT program)
install(FILES ${REFERENCE_DIR}/meniscus
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/benchmark
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/cases
  ${PROJECT_SOURCE_DIR}/studies DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/LICENSE
  ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
