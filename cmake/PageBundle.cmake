# web/ becomes part of the program: its packages come from the committed lockfile (npm ci), esbuild
# makes the page's script and style sheet of them, and the drawer that node runs; they become string
# literals of the room `report`. Without node or npm, or where the packages cannot be had, the
# literals are empty: reports have tables and no pictures. As a script (-P) this file makes them; else it adds the command that does.
set(BUNDLE_INPUTS package.json package-lock.json .npmrc build.mjs)

function(write_literal TEXT FILE)
  # A literal has to end somewhere: this word is in no script.
  file(WRITE ${FILE}.new "R\"meniscuspage(")
  file(APPEND ${FILE}.new "${TEXT}")
  file(APPEND ${FILE}.new ")meniscuspage\"\n")
  file(COPY_FILE ${FILE}.new ${FILE} ONLY_IF_DIFFERENT)
  file(REMOVE ${FILE}.new)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  foreach(INPUT ${BUNDLE_INPUTS})
    file(COPY_FILE ${WEB}/${INPUT} ${WORK}/${INPUT} ONLY_IF_DIFFERENT)
  endforeach()
  file(SHA256 ${WORK}/package-lock.json WANTED)
  set(INSTALLED "")
  if(EXISTS ${WORK}/installed.txt)
    file(READ ${WORK}/installed.txt INSTALLED)
  endif()
  set(FAILED 0)
  if(NOT INSTALLED STREQUAL WANTED)
    message(STATUS "Fetching the packages of the page")
    execute_process(COMMAND ${NPM} ci --ignore-scripts --loglevel=error --fetch-retries=1 WORKING_DIRECTORY ${WORK}
      OUTPUT_QUIET RESULT_VARIABLE FAILED)
    if(NOT FAILED)
      file(WRITE ${WORK}/installed.txt ${WANTED})
    endif()
  endif()
  if(NOT FAILED)
    execute_process(COMMAND ${NODE} ${WORK}/build.mjs ${WEB}/src ${WORK}/dist
      COMMAND_ERROR_IS_FATAL ANY)
    file(READ ${WORK}/dist/page.js SCRIPT_TEXT)
    file(READ ${WORK}/dist/page.css SHEET_TEXT)
    file(READ ${WORK}/dist/drawer.js DRAWER_TEXT)
  else()
    message(WARNING "npm could not fetch the packages of the page: reports will have no pictures. "
      "Remove ${WORK} to try again.")
    set(SCRIPT_TEXT "")
    set(SHEET_TEXT "")
    set(DRAWER_TEXT "")
    file(REMOVE ${WORK}/installed.txt)
  endif()
  write_literal("${SCRIPT_TEXT}" ${OUT}/page_script_generated.inc)
  write_literal("${SHEET_TEXT}" ${OUT}/page_sheet_generated.inc)
  write_literal("${DRAWER_TEXT}" ${OUT}/drawer_script_generated.inc)
  file(TOUCH ${WORK}/bundle.stamp)
  return()
endif()

option(MENISCUS_PAGE "Build the page and the drawer of pictures, where node and npm are found" ON)
find_program(NODE node)
find_program(NPM npm)
set(NODE_VERSION "")
if(NODE)
  execute_process(COMMAND ${NODE} --version OUTPUT_VARIABLE NODE_VERSION ERROR_QUIET)
  string(REGEX MATCH "[0-9.]+" NODE_VERSION "${NODE_VERSION}")
endif()
set(MENISCUS_HAS_PAGE OFF)
if(MENISCUS_PAGE AND NPM AND NODE_VERSION VERSION_GREATER_EQUAL 18)  # what esbuild asks for
  set(MENISCUS_HAS_PAGE ON)
endif()
set(BUNDLE_DIR ${PROJECT_BINARY_DIR}/generated/meniscus/report)
file(MAKE_DIRECTORY ${BUNDLE_DIR} ${PROJECT_BINARY_DIR}/web)
if(MENISCUS_HAS_PAGE)
  set(WEB_DIR ${PROJECT_SOURCE_DIR}/web)
  file(GLOB BUNDLE_SOURCES CONFIGURE_DEPENDS ${WEB_DIR}/src/*)
  list(TRANSFORM BUNDLE_INPUTS PREPEND ${WEB_DIR}/ OUTPUT_VARIABLE BUNDLE_FILES)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/web/bundle.stamp
    BYPRODUCTS ${BUNDLE_DIR}/page_script_generated.inc ${BUNDLE_DIR}/page_sheet_generated.inc
      ${BUNDLE_DIR}/drawer_script_generated.inc
    COMMAND ${CMAKE_COMMAND} -DWEB=${WEB_DIR} -DWORK=${PROJECT_BINARY_DIR}/web -DOUT=${BUNDLE_DIR}
      -DNODE=${NODE} -DNPM=${NPM} -P ${CMAKE_CURRENT_LIST_FILE}
    DEPENDS ${BUNDLE_FILES} ${BUNDLE_SOURCES} ${CMAKE_CURRENT_LIST_FILE}
    COMMENT "Bundling the page" VERBATIM)
  add_custom_target(meniscus_page DEPENDS ${PROJECT_BINARY_DIR}/web/bundle.stamp)
else()
  message(STATUS "No pictures: node 18 and npm are wanted for them; reports have tables only")
  write_literal("" ${BUNDLE_DIR}/page_script_generated.inc)
  write_literal("" ${BUNDLE_DIR}/page_sheet_generated.inc)
  write_literal("" ${BUNDLE_DIR}/drawer_script_generated.inc)
  add_custom_target(meniscus_page)
endif()
