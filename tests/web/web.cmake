# The page in a browser and the server of the live view.
set(WEB_TESTS ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(WEB_WORK ${CMAKE_CURRENT_BINARY_DIR}/web)

meniscus_static_check(lockfile Python3::Interpreter ${WEB_TESTS}/lockfile.py ${PROJECT_SOURCE_DIR})

if(MENISCUS_HAS_PAGE)
  add_test(NAME watch_misuse COMMAND Python3::Interpreter ${WEB_TESTS}/watch_misuse.py
    $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR}/examples/shear-subcritical.toml
    ${WEB_WORK}/misuse)
  set_tests_properties(watch_misuse PROPERTIES TIMEOUT 600)
  if(MENISCUS_LONG_TESTS)
    add_test(NAME watch_cost COMMAND Python3::Interpreter ${WEB_TESTS}/watch_cost.py
      $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR}/examples/shear-subcritical.toml
      ${WEB_WORK}/cost)
    set_tests_properties(watch_cost PROPERTIES TIMEOUT 900 LABELS long RUN_SERIAL ON)
  endif()
endif()

if(MENISCUS_HAS_PAGE)
  foreach(NAME drawing live_run)
    add_test(NAME web_${NAME} COMMAND ${NODE} ${WEB_TESTS}/${NAME}_test.mjs ${PROJECT_SOURCE_DIR}/web/src)
  endforeach()
endif()

# Pages are the same whatever the program was built with, and a browser is slow enough.
if(NOT MENISCUS_HAS_PAGE OR MENISCUS_SANITIZE OR MENISCUS_COVERAGE)
  return()
endif()

add_executable(make_run web/make_run.cpp report/synthetic_run.cpp)
target_include_directories(make_run PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(make_run PRIVATE meniscus_options meniscus_report)

# The long run: 200 frames of 2,502 vertices, 5,000 triangles.
add_test(NAME web_runs COMMAND ${CMAKE_COMMAND} -DMAKE_RUN=$<TARGET_FILE:make_run>
  -DPROGRAM=$<TARGET_FILE:meniscus_program> -DWORK=${WEB_WORK} -P ${WEB_TESTS}/make_pages.cmake)
set_tests_properties(web_runs PROPERTIES FIXTURES_SETUP web_pages TIMEOUT 300)

add_test(NAME web_page COMMAND ${NODE} ${WEB_TESTS}/page_test.mjs ${PROJECT_BINARY_DIR}/web
  ${WEB_WORK}/long ${WEB_WORK}/comparison.html ${WEB_WORK}/scalars ${WEB_WORK}/pictures)
set_tests_properties(web_page PROPERTIES FIXTURES_REQUIRED web_pages TIMEOUT 300 SKIP_RETURN_CODE 77)

add_test(NAME web_live COMMAND ${NODE} ${WEB_TESTS}/live_test.mjs ${PROJECT_BINARY_DIR}/web
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR}/examples/shear-subcritical.toml ${WEB_WORK}/live)
set_tests_properties(web_live PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
