# The program, and the package meniscus that exports meniscus::meniscus: every room but the program's.
include(CMakePackageConfigHelpers)
set(PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/meniscus)

get_property(ROOMS GLOBAL PROPERTY MENISCUS_ROOMS)
list(REMOVE_ITEM ROOMS meniscus_app)
add_library(meniscus INTERFACE)
add_library(meniscus::meniscus ALIAS meniscus)
target_link_libraries(meniscus INTERFACE ${ROOMS})

install(TARGETS meniscus_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS meniscus ${ROOMS} EXPORT meniscusTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/meniscus ${PROJECT_BINARY_DIR}/generated/meniscus
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/meniscusConfig.cmake.in
  ${PROJECT_BINARY_DIR}/meniscusConfig.cmake INSTALL_DESTINATION ${PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meniscusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT meniscusTargets NAMESPACE meniscus:: DESTINATION ${PACKAGE_DIR})
install(FILES ${PROJECT_BINARY_DIR}/meniscusConfig.cmake
  ${PROJECT_BINARY_DIR}/meniscusConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake
  DESTINATION ${PACKAGE_DIR})
