# Installation: headers as they are spelled in the tree, one target per folder, find_package(dmocbench).
include(CMakePackageConfigHelpers)

set(DMOCBENCH_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/dmocbench)
get_property(dmocbench_targets GLOBAL PROPERTY DMOCBENCH_TARGETS)
install(
  TARGETS ${dmocbench_targets}
  EXPORT dmocbenchTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dmocbench)
set(umbrellas dmocbench_version dmocbench_dmocbench)
if(DMOCBENCH_EXTENSIONS)
  list(APPEND umbrellas dmocbench_extensions)
endif()
install(
  TARGETS ${umbrellas}
  EXPORT dmocbenchTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES problems/umbrella/dmocbench/problems.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dmocbench)
install(
  EXPORT dmocbenchTargets
  NAMESPACE dmocbench::
  DESTINATION ${DMOCBENCH_CMAKE_DIR})
get_property(DMOCBENCH_WITH_ADOLC GLOBAL PROPERTY DMOCBENCH_WITH_ADOLC)
configure_package_config_file(methods/dmocbenchConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/dmocbenchConfig.cmake
                              INSTALL_DESTINATION ${DMOCBENCH_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dmocbenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dmocbenchConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/dmocbenchConfigVersion.cmake DESTINATION ${DMOCBENCH_CMAKE_DIR})
install(FILES problems/add_problems.cmake problems/problem_library.cpp.in DESTINATION ${DMOCBENCH_CMAKE_DIR})
if(DMOCBENCH_WITH_ADOLC)
  install(FILES methods/FindADOLC.cmake DESTINATION ${DMOCBENCH_CMAKE_DIR})
endif()
