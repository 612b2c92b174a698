# Finds what the Python module needs. MENISCUS_HAS_PYTHON says whether it is built. The interpreter is
# Debian's, whatever else is called python3: NumPy and pybind11 are packaged for it.
set(MENISCUS_HAS_PYTHON FALSE)
if(NOT MENISCUS_PYTHON)
  message(STATUS "Python module: left out (MENISCUS_PYTHON=OFF)")
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python COMPONENTS Interpreter Development.Module QUIET)
find_package(pybind11 CONFIG QUIET)
if(NOT Python_FOUND OR NOT pybind11_FOUND)
  message(STATUS "Python module: left out (it needs the packages pybind11-dev and python3-dev)")
  return()
endif()
set(MENISCUS_HAS_PYTHON TRUE)

# Debian's python3 looks in lib/python3/dist-packages below /usr, in lib/python3.N/dist-packages below
# /usr/local; other prefixes need PYTHONPATH.
set(MENISCUS_PYTHON_DIR "" CACHE STRING "Where the Python package is installed, relative to the prefix")
if(NOT MENISCUS_PYTHON_DIR)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(MENISCUS_PYTHON_DIR lib/python3/dist-packages)
  else()
    set(MENISCUS_PYTHON_DIR lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages)
  endif()
endif()
message(STATUS "Python module: for ${Python_EXECUTABLE} ${Python_VERSION}")
