# Installs the build into a folder of its own, then configures, builds and runs the consumer against it,
# and of the lessons of examples/programs, which are a project as well, the one that links most rooms.
#   cmake -DBUILD=<build tree> -DWORK=<folder to use> -DSOURCE=<this folder>
#     -DPYTHON3=<any interpreter>
#     [-DPYTHON=<interpreter> -DPYTHON_DIR=<where the package lies below the prefix>] -P run.cmake
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(build SOURCES FOLDER PROGRAM)
  run(${CMAKE_COMMAND} -S ${SOURCES} -B ${FOLDER} -G Ninja -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_PREFIX_PATH=${WORK}/prefix)
  run(${CMAKE_COMMAND} --build ${FOLDER} --target ${PROGRAM})
  run(${CMAKE_COMMAND} -E chdir ${FOLDER} ./${PROGRAM})
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
build(${SOURCE} ${WORK}/build consumer)
run(${WORK}/prefix/bin/meniscus --version)
run(${CMAKE_COMMAND} -E chdir ${WORK} ./prefix/bin/meniscus check cases/uniaxial-extension --recorded)
run(${PYTHON3} -B ${SOURCE}/../../site/build.py --check ${WORK}/prefix/share/doc/meniscus)
if(PYTHON)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${WORK}/prefix/${PYTHON_DIR} PYTHONDONTWRITEBYTECODE=1 ${PYTHON} -c
      "import meniscus; print(meniscus.__file__, meniscus.explain('drop.nodes'))")
endif()
build(${SOURCE}/../../examples/programs ${WORK}/lessons own_flow)
