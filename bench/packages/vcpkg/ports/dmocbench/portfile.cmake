# A port for the sources in which it lies:
#   vcpkg install dmocbench --overlay-ports=bench/packages/vcpkg/ports
cmake_path(ABSOLUTE_PATH CMAKE_CURRENT_LIST_DIR NORMALIZE)
cmake_path(SET SOURCE_PATH NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../../..")

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DDMOCBENCH_WARNINGS_AS_ERRORS=OFF -DDMOCBENCH_ADOLC=OFF -DDMOCBENCH_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/dmocbench)
vcpkg_copy_tools(TOOL_NAMES dmocbench AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
