# Everything comes from Debian 12's packages; scripts/setup.sh installs them.
# Installed beside meniscusConfig.cmake, which includes it too.
include_guard(DIRECTORY)
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
pkg_check_modules(FMT_SPDLOG REQUIRED IMPORTED_TARGET spdlog fmt)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(Boost REQUIRED)  # headers
find_package(CGAL REQUIRED)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
find_package(MPI REQUIRED COMPONENTS C)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)

find_package(ZLIB REQUIRED)
pkg_check_modules(RSVG REQUIRED IMPORTED_TARGET librsvg-2.0 cairo)
pkg_check_modules(MICROHTTPD REQUIRED IMPORTED_TARGET libmicrohttpd)

set(HDF5_PREFER_PARALLEL TRUE)
find_package(HDF5 REQUIRED COMPONENTS C)
add_library(hdf5::meniscus INTERFACE IMPORTED)
target_include_directories(hdf5::meniscus INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(hdf5::meniscus INTERFACE ${HDF5_LIBRARIES} MPI::MPI_C)

find_package(VTK REQUIRED COMPONENTS IOXML CommonCore CommonDataModel)

find_library(TETGEN_LIBRARY tet REQUIRED)
find_path(TETGEN_INCLUDE_DIR tetgen.h REQUIRED)
add_library(tetgen::tet UNKNOWN IMPORTED)
set_target_properties(tetgen::tet PROPERTIES IMPORTED_LOCATION ${TETGEN_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${TETGEN_INCLUDE_DIR} INTERFACE_COMPILE_DEFINITIONS TETLIBRARY)
