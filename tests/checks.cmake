# Checks of the tree itself (label static: they need no build), of the package and of the program.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

function(meniscus_static_check NAME)
  add_test(NAME ${NAME} COMMAND ${ARGN})
  set_tests_properties(${NAME} PROPERTIES LABELS static)
endfunction()

meniscus_static_check(format ${PROJECT_SOURCE_DIR}/scripts/check_format.sh)
meniscus_static_check(run_tutorial_check Python3::Interpreter -B
  ${CMAKE_CURRENT_SOURCE_DIR}/tutorial/run_tutorial_test.py)
foreach(CHECK layers citations metadata)
  set(FOLDER ${CMAKE_CURRENT_SOURCE_DIR}/${CHECK})
  meniscus_static_check(${CHECK} Python3::Interpreter ${FOLDER}/check_${CHECK}.py
    ${PROJECT_SOURCE_DIR})
  meniscus_static_check(${CHECK}_check Python3::Interpreter -B ${FOLDER}/check_${CHECK}_test.py)
endforeach()
# A report: its table says how long the sentences of each page are, and no length makes it fail.
set(FOLDER ${CMAKE_CURRENT_SOURCE_DIR}/words)
meniscus_static_check(sentence_lengths Python3::Interpreter ${FOLDER}/sentence_lengths.py
  ${PROJECT_SOURCE_DIR})
meniscus_static_check(sentence_lengths_check Python3::Interpreter -B ${FOLDER}/sentence_lengths_test.py)

meniscus_static_check(links Python3::Interpreter -B ${PROJECT_SOURCE_DIR}/site/build.py --check)

# A program that links the rooms named after its source.
function(meniscus_program_of_tests TARGET SOURCE)
  add_executable(${TARGET} ${SOURCE} ${MENISCUS_PROGRAM_SOURCES})
  target_link_libraries(${TARGET} PRIVATE meniscus_options)
  foreach(ROOM ${ARGN})
    target_link_libraries(${TARGET} PRIVATE meniscus_${ROOM})
  endforeach()
endfunction()

add_test(NAME end_to_end COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/run.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/end_to_end)
set_tests_properties(end_to_end PROPERTIES TIMEOUT 900)

# An instrumented library asks its flags of whoever links it; the plain builds carry this test.
if(NOT MENISCUS_SANITIZE AND NOT MENISCUS_COVERAGE)
  if(MENISCUS_HAS_PYTHON)
    set(PACKAGED_PYTHON -DPYTHON=${Python_EXECUTABLE} -DPYTHON_DIR=${MENISCUS_PYTHON_DIR})
  endif()
  add_test(NAME package COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
    -DWORK=${CMAKE_CURRENT_BINARY_DIR}/package -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/package
    -DPYTHON3=${Python3_EXECUTABLE} ${PACKAGED_PYTHON}
    -P ${CMAKE_CURRENT_SOURCE_DIR}/package/run.cmake)
  set_tests_properties(package PROPERTIES TIMEOUT 900)
endif()

add_test(NAME interrupted COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/interrupted.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/interrupted)
set_tests_properties(interrupted PROPERTIES TIMEOUT 900)

# Every tenth write, rename and fsync of a run fails; with the long suites every one. (The address
# sanitizer must be loaded before any other library.)
if(NOT MENISCUS_SANITIZE)
  add_library(failing_calls SHARED ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/failing_calls.c)
  target_link_libraries(failing_calls PRIVATE ${CMAKE_DL_LIBS})
  set(STRIDE 10)
  if(MENISCUS_LONG_TESTS)
    set(STRIDE 1)
  endif()
  add_test(NAME every_fault COMMAND Python3::Interpreter
    ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/every_fault.py $<TARGET_FILE:meniscus_program>
    $<TARGET_FILE:failing_calls> ${CMAKE_CURRENT_BINARY_DIR}/every_fault ${STRIDE})
  set_tests_properties(every_fault PROPERTIES TIMEOUT 900)
endif()

# `make check-long` runs ten thousand under the sanitizers.
add_test(NAME fuzz COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/fuzz.py
  $<TARGET_FILE:meniscus_program> ${CMAKE_CURRENT_BINARY_DIR}/fuzz 200)
set_tests_properties(fuzz PROPERTIES TIMEOUT 900)

add_test(NAME study COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/study.py
  $<TARGET_FILE:meniscus_program> ${CMAKE_CURRENT_BINARY_DIR}/study)
set_tests_properties(study PROPERTIES TIMEOUT 300)

add_test(NAME die COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/die.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/die)
set_tests_properties(die PROPERTIES TIMEOUT 300)

add_test(NAME refusals COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/refusals.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/refusals)
set_tests_properties(refusals PROPERTIES TIMEOUT 300)

add_test(NAME benchmark COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/benchmark.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/benchmark)
set_tests_properties(benchmark PROPERTIES TIMEOUT 300)

add_test(NAME remesh COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/remesh.py
  $<TARGET_FILE:meniscus_program> ${CMAKE_CURRENT_BINARY_DIR}/remesh)
set_tests_properties(remesh PROPERTIES TIMEOUT 900)

foreach(solver boundary-integral P1-P1 P2-P1)
  add_test(NAME events_${solver} COMMAND Python3::Interpreter
    ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/events.py
    $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/events/${solver}
    ${solver})
  set_tests_properties(events_${solver} PROPERTIES TIMEOUT 900)
endforeach()

add_test(NAME two_solvers COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/two_solvers.py
  $<TARGET_FILE:meniscus_program> ${CMAKE_CURRENT_BINARY_DIR}/two_solvers)
set_tests_properties(two_solvers PROPERTIES TIMEOUT 900)

# The validation cases, those of their runs that take seconds.
add_test(NAME short_cases COMMAND meniscus_program check --all --short -q
  --cases ${PROJECT_SOURCE_DIR}/cases -o ${CMAKE_CURRENT_BINARY_DIR}/short_cases)
set_tests_properties(short_cases PROPERTIES TIMEOUT 900)
# One run of a case, named in --cases, as it was recorded: nothing is simulated.
add_test(NAME recorded_case COMMAND meniscus_program check --recorded
  --run "boundary integral, N0 = 110" -o ${CMAKE_CURRENT_BINARY_DIR}/recorded_case
  --cases ${PROJECT_SOURCE_DIR}/cases small-deformation)

add_test(NAME variants COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/variants.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/variants)
set_tests_properties(variants PROPERTIES TIMEOUT 900)

add_test(NAME ranks COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/ranks.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/ranks
  ${MPIEXEC_EXECUTABLE})
set_tests_properties(ranks PROPERTIES TIMEOUT 900 LABELS mpi PROCESSORS 3
  ENVIRONMENT "${MENISCUS_RANKS_ENVIRONMENT}")

add_test(NAME event_ranks COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/event_ranks.py $<TARGET_FILE:meniscus_program>
  ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/event_ranks ${MPIEXEC_EXECUTABLE})
set_tests_properties(event_ranks PROPERTIES TIMEOUT 900 LABELS mpi PROCESSORS 3
  ENVIRONMENT "${MENISCUS_RANKS_ENVIRONMENT}")

add_test(NAME inertia COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/inertia.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/inertia)
set_tests_properties(inertia PROPERTIES TIMEOUT 900)

add_test(NAME scalars COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/scalars.py
  $<TARGET_FILE:meniscus_program> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/scalars)
set_tests_properties(scalars PROPERTIES TIMEOUT 600 LABELS end_to_end)

# The Python module by Debian's interpreter. The address sanitizer must be loaded before any other library.
if(MENISCUS_HAS_PYTHON)
  set(PYTHON_TESTS ${PROJECT_SOURCE_DIR}/python/tests)
  add_library(failing_mesher SHARED ${PYTHON_TESTS}/failing_mesher.cpp)
  target_link_libraries(failing_mesher PRIVATE tetgen::tet)
  set(PYTHON_ENVIRONMENT PYTHONPATH=${PROJECT_BINARY_DIR}/python MENISCUS_PROGRAM=$<TARGET_FILE:meniscus_program>
    MENISCUS_MPIEXEC=${MPIEXEC_EXECUTABLE} MENISCUS_FAILING_MESHER=$<TARGET_FILE:failing_mesher>
    PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg ${MENISCUS_RANKS_ENVIRONMENT})
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libasan.so
    OUTPUT_VARIABLE ASAN_LIBRARY OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libstdc++.so
    OUTPUT_VARIABLE STDCXX_LIBRARY OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(PYTHON_SANITIZED "LD_PRELOAD=${ASAN_LIBRARY} ${STDCXX_LIBRARY}" ASAN_OPTIONS=detect_leaks=0)
  if(MENISCUS_SANITIZE)
    list(APPEND PYTHON_ENVIRONMENT ${PYTHON_SANITIZED})
  else()
    # No view dangles: an uninstrumented module suffices, for the sanitizer sees what is copied from a view.
    add_test(NAME python_views COMMAND ${Python_EXECUTABLE} -m unittest test_views WORKING_DIRECTORY ${PYTHON_TESTS})
    set_tests_properties(python_views PROPERTIES TIMEOUT 120 ENVIRONMENT "${PYTHON_ENVIRONMENT};${PYTHON_SANITIZED}")
  endif()
  add_test(NAME python COMMAND ${Python_EXECUTABLE} -m unittest discover -s ${PYTHON_TESTS})
  set_tests_properties(python PROPERTIES TIMEOUT 300 LABELS mpi PROCESSORS 2
    ENVIRONMENT "${PYTHON_ENVIRONMENT}")
endif()

# A program of one's own that puts fields on a run.
meniscus_program_of_tests(passive_scalar ${PROJECT_SOURCE_DIR}/examples/programs/passive_scalar.cpp app)
meniscus_program_of_tests(field_difference end_to_end/field_difference.cpp io)
add_test(NAME fields COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/end_to_end/fields.py
  $<TARGET_FILE:passive_scalar> $<TARGET_FILE:meniscus_program> $<TARGET_FILE:field_difference>
  ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/fields ${MPIEXEC_EXECUTABLE})
set_tests_properties(fields PROPERTIES TIMEOUT 900 LABELS mpi PROCESSORS 3
  ENVIRONMENT "${MENISCUS_RANKS_ENVIRONMENT}")

# Pages whose commands are run and whose quotations are held to what they print.
function(meniscus_page_test NAME PROGRAMS PAGES)
  add_test(NAME ${NAME} COMMAND Python3::Interpreter -B
    ${CMAKE_CURRENT_SOURCE_DIR}/tutorial/run_tutorial.py ${CMAKE_CURRENT_BINARY_DIR}/${NAME}
    --programs ${PROGRAMS} --pages ${PAGES} ${ARGN})
  set_tests_properties(${NAME} PROPERTIES TIMEOUT 900)
endfunction()

file(GLOB TUTORIAL_PAGES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/tutorial/*.md)
if(MENISCUS_HAS_PYTHON AND NOT MENISCUS_SANITIZE)
  meniscus_page_test(tutorial $<TARGET_FILE:meniscus_program> "${TUTORIAL_PAGES}" --python ${Python_EXECUTABLE})
  set_tests_properties(tutorial PROPERTIES ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;MPLBACKEND=Agg")
else()
  list(FILTER TUTORIAL_PAGES EXCLUDE REGEX "/5-figure.md$")  # it draws with the module
  meniscus_page_test(tutorial $<TARGET_FILE:meniscus_program> "${TUTORIAL_PAGES}")
endif()

# The lessons of examples/programs: each fails where its figures miss the theory.
function(meniscus_lesson NAME)
  meniscus_program_of_tests(${NAME} ${PROJECT_SOURCE_DIR}/examples/programs/${NAME}.cpp ${ARGN})
endfunction()
meniscus_lesson(remesh_surface solids io)
meniscus_lesson(mesh_scene volume io)
meniscus_lesson(one_solve flow_fem flow_bem)
meniscus_lesson(own_flow evolve io)
meniscus_page_test(library_tutorial
  "$<TARGET_FILE:remesh_surface>;$<TARGET_FILE:mesh_scene>;$<TARGET_FILE:one_solve>;$<TARGET_FILE:own_flow>"
  ${PROJECT_SOURCE_DIR}/docs/library-tutorial.md)

# Dynamics against independent references, all runs but those made once: an hour or more.
if(MENISCUS_LONG_TESTS)
  add_test(NAME cases COMMAND meniscus_program check --all --quiet
    --cases ${PROJECT_SOURCE_DIR}/cases --output ${CMAKE_CURRENT_BINARY_DIR}/cases)
  set_tests_properties(cases PROPERTIES TIMEOUT 14400 LABELS long)
endif()
