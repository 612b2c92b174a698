# The case files of examples/ become part of the program: `meniscus examples` writes them out.
file(GLOB EXAMPLE_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*.toml)
set(EXAMPLE_ENTRIES "")
foreach(FILE ${EXAMPLE_FILES})
  get_filename_component(NAME ${FILE} NAME_WE)
  file(READ ${FILE} TEXT)
  string(APPEND EXAMPLE_ENTRIES "{\"${NAME}\", R\"toml(${TEXT})toml\"},\n")
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${EXAMPLE_FILES})
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/meniscus/case/examples_generated.inc
     CONTENT "@EXAMPLE_ENTRIES@" @ONLY)
