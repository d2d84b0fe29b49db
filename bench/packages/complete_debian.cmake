# Called by cpack between installing and packing, see debian.cmake.
execute_process(
  COMMAND ${CPACK_DMOCBENCH_SOURCE}/bench/packages/complete_debian ${CPACK_TEMPORARY_DIRECTORY} ${CPACK_PACKAGE_VERSION}
          ${CPACK_DEBIAN_PACKAGE_RELEASE} ${CPACK_PACKAGE_CONTACT} COMMAND_ERROR_IS_FATAL ANY)
