# Links the objects of a Release build in place of compiling them again with sanitizers: the tests, and folders of methods that
# leave memory to others. CMake includes this file after project() where CMAKE_PROJECT_INCLUDE names it; the folder of the
# Release build is DMOCBENCH_COMPILED.
function(dmocbench_link_compiled target folder)
  file(GLOB_RECURSE objects ${DMOCBENCH_COMPILED}/${folder}/CMakeFiles/${target}.dir/*.o)
  if(NOT objects)
    message(FATAL_ERROR "${DMOCBENCH_COMPILED} has no objects of ${target}: build it there first")
  endif()
  set_target_properties(${target} PROPERTIES SOURCES "${objects}" LINKER_LANGUAGE CXX DISABLE_PRECOMPILE_HEADERS ON)
endfunction()

# No test reads the headers of tests_expression beforehand, which is not compiled here.
function(dmocbench_precompile_no_tests folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  list(FILTER targets INCLUDE REGEX "^tests_")
  if(targets)
    set_target_properties(${targets} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  endif()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    dmocbench_precompile_no_tests(${below})
  endforeach()
endfunction()

function(dmocbench_link_compiled_folders)
  foreach(folder mechanics diagnostics)
    dmocbench_link_compiled(dmocbench_${folder} methods/${folder})
  endforeach()
  foreach(folder expression runtime numerics support program kkt judgement transcription solvers)
    get_property(targets DIRECTORY tests/${folder} PROPERTY BUILDSYSTEM_TARGETS)
    list(FILTER targets INCLUDE REGEX "^tests_")
    list(REMOVE_ITEM targets tests_counted_allocations) # objects of it have to be objects of this build
    foreach(target IN LISTS targets)
      dmocbench_link_compiled(${target} tests/${folder})
    endforeach()
  endforeach()
  dmocbench_precompile_no_tests(tests)
endfunction()
cmake_language(DEFER CALL dmocbench_link_compiled_folders)
