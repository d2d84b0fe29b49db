# Installation of the program dmocbench, which contains every experiment, the figures, and the frame of experiments as a
# target of the package.
install(TARGETS bench_dmocbench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

set(plots ${CMAKE_INSTALL_DATADIR}/dmocbench/plots)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/plots/
  DESTINATION ${plots}
  COMPONENT program
  PATTERN README.md EXCLUDE
  PATTERN images EXCLUDE
  PATTERN report EXCLUDE # is in the program
  PATTERN figures EXCLUDE)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/plots/figures DESTINATION ${plots} COMPONENT program)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_DATADIR BASE_DIRECTORY ${CMAKE_INSTALL_FULL_BINDIR} OUTPUT_VARIABLE data)
install(CODE "file(CREATE_LINK ${data}/dmocbench/plots/figures
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/dmocbench-figures\" SYMBOLIC)"
  COMPONENT program)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/bench/compare_results DESTINATION ${CMAKE_INSTALL_DATADIR}/dmocbench COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/bench/csv.awk DESTINATION ${CMAKE_INSTALL_DATADIR}/dmocbench COMPONENT program)
install(CODE "file(CREATE_LINK ${data}/dmocbench/compare_results
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/dmocbench-compare\" SYMBOLIC)"
  COMPONENT program)
install(CODE "execute_process(COMMAND ${PROJECT_SOURCE_DIR}/bench/packages/man_pages
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\"
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1\" ${PROJECT_VERSION} COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT program)
install(
  FILES ${PROJECT_SOURCE_DIR}/bench/packages/completion.bash
  RENAME dmocbench
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program)

install(
  TARGETS dmocbench_experiment
  EXPORT dmocbenchExperimentTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dmocbench
  FILE_SET umbrella DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(
  EXPORT dmocbenchExperimentTargets
  NAMESPACE dmocbench::
  DESTINATION ${DMOCBENCH_CMAKE_DIR})
