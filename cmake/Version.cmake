# generated/meniscus/core/version.hpp: the version from project(), the commit from git at every build.
# The file changes only when its text does, so that nothing is recompiled in vain.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(VERSION_COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DBINARY=${PROJECT_BINARY_DIR}
    -DPROJECT_VERSION=${PROJECT_VERSION} -P ${CMAKE_CURRENT_LIST_FILE})
  execute_process(COMMAND ${VERSION_COMMAND} COMMAND_ERROR_IS_FATAL ANY)
  add_custom_target(meniscus_version COMMAND ${VERSION_COMMAND} COMMENT "Reading the commit"
    BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/meniscus/core/version.hpp)
  return()
endif()

find_program(GIT git)
set(MENISCUS_COMMIT unknown)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --abbrev=12 --dirty --exclude=*
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE FAILED)
  if(NOT FAILED)
    set(MENISCUS_COMMIT ${COMMIT})
  endif()
endif()
configure_file(${SOURCE}/meniscus/core/version.hpp.in ${BINARY}/generated/meniscus/core/version.hpp
  @ONLY)
