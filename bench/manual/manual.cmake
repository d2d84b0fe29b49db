# The manual, by Doxygen: `cmake --build build --target manual`. It documents the installed files: the headers of all
# targets of the package, and the Markdown pages next to the code.
get_property(targets GLOBAL PROPERTY DMOCBENCH_TARGETS)
set(inputs)
foreach(target IN LISTS targets ITEMS dmocbench_experiment)
  get_target_property(headers ${target} HEADER_SET)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(header IN LISTS headers)
    cmake_path(ABSOLUTE_PATH header BASE_DIRECTORY ${folder} NORMALIZE)
    list(APPEND inputs ${header})
  endforeach()
endforeach()
list(FILTER inputs INCLUDE REGEX "^${PROJECT_SOURCE_DIR}/") # no files made by the build
list(FILTER inputs EXCLUDE REGEX "^${PROJECT_BINARY_DIR}/")
file(GLOB_RECURSE pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/methods/*.md ${PROJECT_SOURCE_DIR}/bench/*.md
     ${PROJECT_SOURCE_DIR}/plots/*.md ${PROJECT_SOURCE_DIR}/tests/tutorials/*.md)
list(FILTER pages EXCLUDE REGEX "/paper\\.md$") # for another reader
list(APPEND inputs ${pages} ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
     ${CMAKE_CURRENT_LIST_DIR}/folders.dox)
list(REMOVE_DUPLICATES inputs)
list(JOIN inputs " \\\n  " inputs)
configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${PROJECT_BINARY_DIR}/manual/Doxyfile @ONLY)

find_program(DMOCBENCH_DOXYGEN doxygen)
if(DMOCBENCH_DOXYGEN)
  add_custom_target(
    manual
    COMMAND ${DMOCBENCH_DOXYGEN} ${PROJECT_BINARY_DIR}/manual/Doxyfile
    COMMAND ${CMAKE_COMMAND} -E echo "manual: ${PROJECT_BINARY_DIR}/manual/html/index.html"
    VERBATIM)
else()
  add_custom_target(manual COMMAND ${CMAKE_COMMAND} -E echo "doxygen is missing; install it with bench/install --ci" COMMAND ${CMAKE_COMMAND} -E false)
endif()
